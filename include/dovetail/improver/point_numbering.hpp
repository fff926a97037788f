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

  point_numbering(const std::vector<bool>& is_fixed, std::size_t count);
};

/// Puts the points without elements, at the gaps, where no other point is: each into an element of its own.
template <int D>
void fill_gaps(const point_numbering& numbers, simplicial_mesh<D>& mesh) {
  for (std::size_t k = 0; k < std::min(numbers.gaps.size(), mesh.elements.size()); ++k) {
    vec3 sum;
    for (const local_id v : mesh.elements[k])
      sum += mesh.points[v];
    mesh.points[numbers.gaps[k]] = sum / (D + 1);
  }
}

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/point_numbering.ipp"
#endif
