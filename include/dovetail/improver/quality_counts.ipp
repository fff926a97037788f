/// @file
/// What `quality_counts.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/improver/quality_counts.hpp"

#include <string>
#include <utility>

namespace dovetail::improvement {

DOVETAIL_INLINE void quality_counts::write_to(report& to, const std::string& when) const {
  for (const auto& [name, counts] : {std::pair{"limited", limited}, std::pair{"free", free}}) {
    const std::string prefix = when + " " + name + " ";
    to.set(prefix + "elements", static_cast<double>(counts.elements));
    to.set(prefix + "inverted", static_cast<double>(counts.inverted));
    to.set(prefix + "bad", static_cast<double>(counts.bad));
    to.set(prefix + "low", static_cast<double>(counts.low));
    to.set(prefix + "min angle", counts.min_angle);
    to.set(prefix + "max angle", counts.max_angle);
  }
}

DOVETAIL_INLINE quality_counts quality_counter::result() const {
  quality_counts result = counts_;
  set_angles(result.limited, of_limited_);
  set_angles(result.free, of_free_);
  return result;
}

DOVETAIL_INLINE void quality_counter::set_angles(quality_counts::of_class& counted, const extremes& extreme) {
  if (counted.elements == counted.inverted)
    return;
  counted.min_angle = degrees(extreme.of_smallest);
  counted.max_angle = degrees(extreme.of_largest);
}

} // namespace dovetail::improvement
