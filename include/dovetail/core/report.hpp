/// @file
/// What a stage says about itself: wall time, counters and warnings, nested like the pipeline.
#pragma once

#include "dovetail/core/fields.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Plain data that each stage returns beside its result.
struct report {
  std::string name;                                     ///< of the stage or part
  double seconds = 0;                                   ///< wall time
  std::vector<std::pair<std::string, double>> counters; ///< in the order they were set
  std::vector<std::string> warnings;                    ///< one sentence each, naming the entity
  std::vector<report> children;        ///< the reports of its parts, in the order they were made
  std::vector<std::string> files = {}; ///< written by it, by their names in its folder

  using fields = field_list<&report::name, &report::seconds, &report::counters, &report::warnings,
                            &report::children, &report::files>;

  /// Sets a counter, replacing an earlier value.
  void set(const std::string& key, double value);
  /// Adds to a counter that starts at zero.
  void add(const std::string& key, double value) { set(key, get(key) + value); }
  /// The counter's value, or `otherwise` if it was never set.
  double get(const std::string& key, double otherwise = 0) const;
  /// The part of that name, one of the children before one of theirs; an empty report when there is none.
  const report& find(const std::string& part) const;
};

/// How often a limit of wall-clock time, and not the input, has decided what came next: the counter
/// "stops_by_clock" of a report and of its parts. Where it is not 0 another run may make another mesh.
double stops_by_clock(const report& made);

/// Wall-clock stopwatch.
class stopwatch {
public:
  /// Seconds since it was made.
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/report.ipp"
#endif
