/// @file
/// What is done about the points of a boundary before they are triangulated.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail::detail {

/// Corners of a box so far around the points that no side of the convex hull is near any of them: all that
/// recovery changes then lies between finite elements.
inline void append_far_corners(std::vector<vec3>& points) {
  constexpr double distance = 2; // over the diagonal of the points' box
  box3 box;
  for (const vec3 p : points)
    box.include(p);
  const double reach = distance * box.diagonal();
  for (unsigned k = 0; k < 8; ++k)
    points.push_back(box.center() + reach * vec3{(k & 1U) != 0 ? 1.0 : -1.0, (k & 2U) != 0 ? 1.0 : -1.0,
                                                 (k & 4U) != 0 ? 1.0 : -1.0});
}

/// Two vertices of the boundary at one place can be given by no tetrahedrization.
inline void require_distinct_vertices(const simplicial_mesh<2>& boundary,
                                      const std::vector<local_id>& same_as) {
  for (const auto& triangle : boundary.elements)
    for (const local_id v : triangle)
      if (same_as[v] != v)
        throw mesher_error("boundary points " + std::to_string(same_as[v]) + " and " + std::to_string(v) +
                           " are both at " + place_text(boundary.points[v]) + "; make them one");
}

} // namespace dovetail::detail
