/// @file
/// What `curvature.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/sizing/curvature.hpp"

#include <algorithm>

namespace dovetail::sizing {

DOVETAIL_INLINE model_size_range range_for(const box3& bounds, model_size_range range) {
  const double diagonal = checked_size(bounds.diagonal(), "the diagonal of the model");
  checked_length(range.smallest, "the smallest size");
  checked_length(range.largest, "the largest size");
  if (range.largest == 0)
    range.largest = 0.1 * diagonal;
  if (range.smallest == 0)
    range.smallest = std::min(1e-3 * diagonal, range.largest);
  if (range.smallest > range.largest)
    throw sizing_error("the smallest size " + number_text(range.smallest) + " exceeds the largest " +
                       number_text(range.largest) + "; exchange them");
  return range;
}

} // namespace dovetail::sizing
