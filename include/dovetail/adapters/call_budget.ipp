/// @file
/// What `call_budget.hpp` declares.
#pragma once

#include "dovetail/adapters/call_budget.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/octree.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <algorithm>
#include <cstddef>

namespace dovetail::detail {

DOVETAIL_INLINE double integral_of_inverse_cube(const any_sizing& size, const box3& whole) {
  double sum = 0;
  descend_octants(whole, [&](const box3& box, int depth) {
    const vec3 center = box.center();
    const vec3 extent = box.upper - box.lower;
    double smallest = checked_size(size, center);
    double largest = smallest;
    for (unsigned k = 0; k < 8; ++k) { // the middles of its octants
      const vec3 from_center{(k & 1U) != 0 ? extent.x : -extent.x, (k & 2U) != 0 ? extent.y : -extent.y,
                             (k & 4U) != 0 ? extent.z : -extent.z};
      const double h = checked_size(size, center + 0.25 * from_center);
      smallest = std::min(smallest, h);
      largest = std::max(largest, h);
    }
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (depth < 7 && longest >= 2 * smallest && (depth < 2 || largest >= 1.5 * smallest))
      return true;
    sum += extent.x * extent.y * extent.z / (smallest * smallest * smallest);
    return false;
  });
  return sum;
}

} // namespace dovetail::detail

namespace dovetail {

DOVETAIL_INLINE std::size_t sizing_call_budget(const simplicial_mesh<2>& boundary, const any_sizing& size,
                                               double elements_per_inverse_cubed_size, double factor) {
  box3 box;
  for (const vec3 p : boundary.points)
    box.include(p);
  const double predicted = elements_per_inverse_cubed_size * detail::integral_of_inverse_cube(size, box);
  const double for_boundary = 50.0 * static_cast<double>(boundary.elements.size());
  const double calls = factor * (predicted + for_boundary);
  return calls < 1e18 ? static_cast<std::size_t>(calls) : static_cast<std::size_t>(1e18);
}

} // namespace dovetail
