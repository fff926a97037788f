/// @file
/// How often each kind of operation was tried and accepted, and what it cost.
#pragma once

#include "dovetail/core/report.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace dovetail::improvement {

enum class operation : std::size_t {
  edge_removal,
  face_removal,
  smoothing,
  shell_transformation,
  contraction,
  insertion,
  count
};

/// Tries, acceptances and seconds per kind of operation.
class operation_log {
public:
  /// Runs `attempt` (which returns whether it changed the mesh) and records it. Only one try in 16 is timed,
  /// so that the clock does not cost more than what it measures; the seconds are scaled accordingly.
  template <class Attempt>
  bool record(operation kind, Attempt&& attempt) {
    auto& counted = entries_[static_cast<std::size_t>(kind)];
    const bool is_timed = counted.tried++ % 16 == 0;
    const stopwatch clock = is_timed ? stopwatch() : never_;
    const bool accepted = attempt();
    counted.accepted += accepted;
    if (is_timed)
      counted.sampled_seconds += clock.seconds();
    return accepted;
  }
  std::size_t accepted(operation kind) const { return entries_[static_cast<std::size_t>(kind)].accepted; }
  std::size_t total_accepted() const {
    std::size_t total = 0;
    for (const auto& counted : entries_)
      total += counted.accepted;
    return total;
  }
  void write_to(report& to) const {
    static constexpr std::array<const char*, static_cast<std::size_t>(operation::count)> names{
        "edge removal", "face removal", "smoothing", "shell transformation", "contraction", "insertion"};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string name = names[k];
      to.set(name + " tried", static_cast<double>(entries_[k].tried));
      to.set(name + " accepted", static_cast<double>(entries_[k].accepted));
      to.set(name + " seconds", 16 * entries_[k].sampled_seconds);
    }
  }

private:
  struct entry {
    std::size_t tried = 0, accepted = 0;
    double sampled_seconds = 0;
  };
  std::array<entry, static_cast<std::size_t>(operation::count)> entries_;
  stopwatch never_;
};

} // namespace dovetail::improvement
