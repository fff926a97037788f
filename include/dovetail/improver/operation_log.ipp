/// @file
/// What `operation_log.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/improver/operation_log.hpp"

namespace dovetail::improvement {

DOVETAIL_INLINE void operation_log::write_to(report& to) const {
  for (const entry& counted : entries_) {
    to.add(counted.name + " tried", static_cast<double>(counted.tried));
    to.add(counted.name + " accepted", static_cast<double>(counted.accepted));
    to.add(counted.name + " seconds", 16 * counted.sampled_seconds);
  }
}

} // namespace dovetail::improvement
