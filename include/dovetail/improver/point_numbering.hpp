/// @file
/// Numbers for points after an improvement: fixed ones keep theirs, the others fill the gaps in order.
#pragma once

#include "dovetail/core/ids.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::improvement {

/// Numbers for `count` free points, ascending: those that no fixed point has. `is_fixed` says of every number
/// in use so far whether it is kept.
struct point_numbering {
  std::vector<local_id> of_free;
  std::size_t size = 0; ///< of the new list of points; a gap before the last fixed point may remain

  point_numbering(const std::vector<bool>& is_fixed, std::size_t count) {
    of_free.reserve(count);
    for (std::size_t number = 0; of_free.size() < count; ++number)
      if (number >= is_fixed.size() || !is_fixed[number])
        of_free.push_back(static_cast<local_id>(number));
    for (size = is_fixed.size(); size > 0 && !is_fixed[size - 1];)
      --size;
    if (!of_free.empty() && static_cast<std::size_t>(of_free.back()) >= size)
      size = static_cast<std::size_t>(of_free.back()) + 1;
  }
};

} // namespace dovetail::improvement
