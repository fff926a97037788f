/// @file
/// What `integer_weights.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/integer_weights.hpp"

#include <algorithm>
#include <span>

namespace dovetail::detail {

DOVETAIL_INLINE void weight_sums::add(const weight_sums& more) {
  count += more.count;
  sum += more.sum;
  largest = std::max(largest, more.largest);
  are_integers = are_integers && more.are_integers;
}

DOVETAIL_INLINE weight_sums sums_of(std::span<const double> weights) {
  weight_sums sums;
  for (const double w : weights)
    sums.add(w);
  return sums;
}

} // namespace dovetail::detail
