/// @file
/// How often each kind of operation was tried and accepted, and what it cost.
#pragma once

#include "dovetail/core/report.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dovetail::improvement {

/// Tries, acceptances and seconds per kind of operation.
class operation_log {
public:
  /// Adds kinds of operations, which have consecutive numbers from the result on.
  std::size_t add(std::span<const char* const> names) {
    const std::size_t first = entries_.size();
    for (const char* name : names)
      entries_.push_back({name});
    return first;
  }
  /// Runs `attempt` (which returns whether it changed the mesh) and records it. Only one try in 16 is timed,
  /// so that the clock does not cost more than what it measures; the seconds are scaled accordingly.
  template <class Attempt>
  bool record(std::size_t kind, Attempt&& attempt) {
    entry& counted = entries_[kind];
    const bool is_timed = counted.tried++ % 16 == 0;
    const stopwatch clock = is_timed ? stopwatch() : never_;
    const bool accepted = attempt();
    counted.accepted += accepted;
    if (is_timed)
      counted.sampled_seconds += clock.seconds();
    return accepted;
  }
  /// Kinds of the same name are added up.
  void write_to(report& to) const;

private:
  struct entry {
    std::string name;
    std::size_t tried = 0, accepted = 0;
    double sampled_seconds = 0;
  };
  std::vector<entry> entries_;
  stopwatch never_;
};

/// What an operation records its tries with: `tries(attempt)`, or `tries(attempt, k)` for the k-th of its
/// names. The result is that of `attempt`, whether it changed the mesh.
class recorded_tries {
public:
  recorded_tries(operation_log& log, std::size_t first) : log_(log), first_(first) {}

  /// Makes a try, times it and records what came of it.
  template <class Attempt>
  bool operator()(Attempt&& attempt, std::size_t name = 0) const {
    return log_.record(first_ + name, attempt);
  }

private:
  operation_log& log_;
  std::size_t first_;
};

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/operation_log.ipp"
#endif
