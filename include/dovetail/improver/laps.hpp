/// @file
/// The seconds of one step after another, for a report.
#pragma once

#include "dovetail/core/report.hpp"

#include <string>

namespace dovetail::improvement {

/// Laps of a stopwatch, written to a report.
class laps {
public:
  explicit laps(report& to) : to_(to) {}

  /// The step that has just ended took the time since the last one did.
  void end(const std::string& step) {
    to_.set(step + " seconds", clock_.seconds());
    clock_ = stopwatch();
  }

private:
  report& to_;
  stopwatch clock_;
};

} // namespace dovetail::improvement
