/// @file
/// What a stage says about itself: wall time, counters and warnings, nested like the pipeline.
#pragma once

#include "dovetail/core/fields.hpp"

#include <chrono>
#include <string>
#include <string_view>
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

  /// Sets a counter for each field of what a stage has counted, under the field's name: numbers, and those
  /// optional ones that are there.
  template <has_fields Counts>
  void set(const Counts& counts);
  /// What `set` was given, read back; a field whose counter was never set stays as it is by default.
  template <has_fields Counts>
  Counts as() const;
  /// Sets a counter, replacing an earlier value.
  void set(const std::string& key, double value);
  /// Adds to a counter that starts at zero.
  void add(const std::string& key, double value) { set(key, get(key, 0) + value); }
  /// The counter's value. Throws `usage_error` that lists the counters when it was never set.
  double get(const std::string& key) const;
  /// The counter's value, or `otherwise` if it was never set.
  double get(const std::string& key, double otherwise) const;
  /// The part of that name, one of the children before one of theirs; an empty report when there is none.
  const report& find(const std::string& part) const;
};

template <has_fields Counts>
void report::set(const Counts& counts) {
  const auto set_number = [this](std::string_view key, auto number) {
    set(std::string(key), static_cast<double>(number));
  };
  for_each_named_field(counts, [&]<class Field>(std::string_view key, const Field& field) {
    if constexpr (requires { field.has_value(); }) {
      if (field)
        set_number(key, *field);
    } else {
      set_number(key, field);
    }
  });
}

template <has_fields Counts>
Counts report::as() const {
  Counts counts;
  for_each_named_field(counts, [this]<class Field>(std::string_view key, Field& field) {
    for (const auto& [counter, value] : counters)
      if (counter == key) {
        if constexpr (requires { field.has_value(); })
          field = static_cast<typename Field::value_type>(value);
        else
          field = static_cast<Field>(value);
      }
  });
  return counts;
}

/// What `stops_by_clock` counts of one report.
struct clock_counts {
  double stops_by_clock = 0;

  using fields = field_list<&clock_counts::stops_by_clock>;
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
