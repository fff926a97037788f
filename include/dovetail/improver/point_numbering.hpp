/// @file
/// Numbers for points after an improvement: fixed ones keep theirs, the others fill the gaps in order.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dovetail::improvement {

/// Numbers for `count` free points, ascending: those that no fixed point has. `is_fixed` says of every number
/// in use so far whether it is kept.
struct point_numbering {
  std::vector<local_id> of_free; ///< the numbers of the free points, ascending
  std::vector<local_id> gaps;    ///< numbers before the last fixed point that nothing takes
  std::size_t size = 0;          ///< of the new list of points

  point_numbering(const std::vector<bool>& is_fixed, std::size_t count) {
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
};

/// Puts the points without elements, at the gaps, where no other point is: each into an element of its own.
template <int D>
void fill_gaps(const point_numbering& numbers, simplicial_mesh<D>& mesh) {
  for (std::size_t k = 0; k < std::min(numbers.gaps.size(), mesh.elements.size()); ++k) {
    vec3 sum;
    for (const local_id v : mesh.elements[k])
      sum += mesh.points[static_cast<std::size_t>(v)];
    mesh.points[static_cast<std::size_t>(numbers.gaps[k])] = sum / (D + 1);
  }
}

} // namespace dovetail::improvement
