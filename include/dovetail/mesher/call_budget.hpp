/// @file
/// How many sizing evaluations a mesher may need at most: the watchdog against endless refinement.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dovetail {

namespace detail {

/// Integral of h^-3 over a box by an octree that splits while the smallest and largest sampled size differ by
/// more than a factor 1.5, to a depth of 7; errs on the large side.
class inverse_size_integral {
public:
  explicit inverse_size_integral(const any_sizing& size) : size_(size) {}

  double over(const box3& box, int depth = 0) const {
    double smallest = checked_size(size_, box.center());
    double largest = smallest;
    for (int corner = 0; corner < 8; ++corner) {
      const double h = checked_size(size_, quarter_point(box, corner));
      smallest = std::min(smallest, h);
      largest = std::max(largest, h);
    }
    const vec3 extent = box.upper - box.lower;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (depth == 7 || longest < 2 * smallest || (depth >= 2 && largest < 1.5 * smallest))
      return extent.x * extent.y * extent.z / (smallest * smallest * smallest);
    double sum = 0;
    for (unsigned k = 0; k < 8; ++k)
      sum += over(octant(box, k), depth + 1);
    return sum;
  }

private:
  static vec3 quarter_point(const box3& box, int corner) {
    vec3 p = box.center();
    for (int k = 0; k < 3; ++k)
      p[k] += ((corner >> k & 1) != 0 ? 0.25 : -0.25) * (box.upper[k] - box.lower[k]);
    return p;
  }
  const any_sizing& size_;
};

} // namespace detail

/// `factor` times the number of elements predicted for the boundary's box (an overestimate of the piece),
/// plus a share for boundaries finer than the field. Deterministic; at most a few million evaluations, a few
/// hundred for a uniform field. Throws `sizing_error` when the field gives an unusable size.
inline std::size_t sizing_call_budget(const simplicial_mesh<2>& boundary, const any_sizing& size,
                                      double elements_per_inverse_cubed_size, double factor) {
  box3 box;
  for (const vec3 p : boundary.points)
    box.include(p);
  const double predicted = elements_per_inverse_cubed_size * detail::inverse_size_integral(size).over(box);
  const double for_boundary = 50.0 * static_cast<double>(boundary.elements.size());
  const double calls = factor * (predicted + for_boundary);
  return calls < 1e18 ? static_cast<std::size_t>(calls) : static_cast<std::size_t>(1e18);
}

} // namespace dovetail
