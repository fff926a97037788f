/// @file
/// What `point_numbering.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/improver/point_numbering.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::improvement {

DOVETAIL_INLINE point_numbering::point_numbering(const std::vector<bool>& is_fixed, std::size_t count) {
  of_free.reserve(count);
  for (std::size_t number = 0; of_free.size() < count; ++number)
    if (number >= is_fixed.size() || !is_fixed[number])
      of_free.push_back(static_cast<local_id>(number));
  for (size = is_fixed.size(); size > 0 && !is_fixed[size - 1];)
    --size;
  if (!of_free.empty() && static_cast<std::size_t>(of_free.back()) >= size)
    size = static_cast<std::size_t>(of_free.back()) + 1;
  const std::size_t next = of_free.empty() ? 0 : static_cast<std::size_t>(of_free.back()) + 1;
  for (std::size_t number = next; number < size; ++number)
    if (!is_fixed[number])
      gaps.push_back(static_cast<local_id>(number));
}

} // namespace dovetail::improvement
