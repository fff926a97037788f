/// @file
/// What is done about the points of a boundary before they are triangulated.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstddef>
#include <string>
#include <utility>
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

/// The points that triangles of a boundary have, in growing order.
inline std::vector<local_id> used_points(const simplicial_mesh<2>& boundary) {
  std::vector<char> is_used(boundary.points.size(), 0);
  for (const auto& triangle : boundary.elements)
    for (const local_id v : triangle)
      is_used[v] = 1;
  std::vector<local_id> used;
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v] != 0)
      used.push_back(static_cast<local_id>(v));
  return used;
}

/// A boundary with its used points alone.
inline simplicial_mesh<2> without_unused_points(const simplicial_mesh<2>& boundary,
                                                const std::vector<local_id>& used) {
  simplicial_mesh<2> result;
  std::vector<local_id> number(boundary.points.size(), no_id);
  for (const local_id v : used) {
    number[v] = static_cast<local_id>(result.points.size());
    result.points.push_back(boundary.points[v]);
  }
  result.elements = boundary.elements;
  for (auto& triangle : result.elements)
    for (local_id& v : triangle)
      v = number[v];
  return result;
}

/// Gives a mesh whose first points are the used ones of a boundary all points of that, by their numbers.
inline void restore_unused_points(simplicial_mesh<3>& mesh, const std::vector<vec3>& given,
                                  const std::vector<local_id>& used) {
  std::vector<vec3> points = given;
  points.insert(points.end(), mesh.points.begin() + static_cast<std::ptrdiff_t>(used.size()),
                mesh.points.end());
  for (auto& element : mesh.elements)
    for (local_id& v : element) {
      const auto k = static_cast<std::size_t>(v);
      v = k < used.size() ? used[k] : static_cast<local_id>(given.size() + k - used.size());
    }
  mesh.points = std::move(points);
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
