/// @file
/// Where the triangulation of points begins: D + 1 of them that span the space.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/triangulation/triangulation.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

inline bool are_collinear(vec2 a, vec2 b, vec2 c) {
  return orient2d(a, b, c) == 0;
}
/// Three points of space are on one line when their shadows on the three planes of coordinates are.
inline bool are_collinear(vec3 a, vec3 b, vec3 c) {
  return orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0 &&
         orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0 &&
         orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0;
}

template <int D>
void require_finite(std::span<const point_of<D>> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double x : coordinates(points[i]))
      if (!std::isfinite(x))
        throw geometry_error("point " + std::to_string(i) + " is not finite");
}

/// Brings the first points that are in general position to the front of `order`; the others keep theirs.
/// Throws `geometry_error` when all are on one line (D = 2) or in one plane (D = 3).
template <int D>
void spanning_points_first(std::span<const point_of<D>> points, std::vector<local_id>& order) {
  const auto at_place = [&](std::size_t k) { return points[order[k]]; };
  const auto independent = [&](std::size_t found, std::size_t k) {
    switch (found) {
    case 0:
      return true;
    case 1:
      return !(at_place(0) == at_place(k));
    case 2:
      return !are_collinear(at_place(0), at_place(1), at_place(k));
    default:
      if constexpr (D == 3)
        return orient3d(at_place(0), at_place(1), at_place(2), at_place(k)) != 0;
      return false;
    }
  };
  std::size_t k = 0;
  for (std::size_t found = 0; found <= static_cast<std::size_t>(D); ++found, ++k) {
    while (k < order.size() && !independent(found, k))
      ++k;
    if (k == order.size())
      throw geometry_error(std::to_string(points.size()) +
                           (D == 2 ? " points, all on one line, have no triangulation"
                                   : " points, all in one plane, have no tetrahedrization"));
    for (std::size_t i = k; i > found; --i)
      std::swap(order[i], order[i - 1]);
  }
}

/// The simplex of vertices 0 to D and its ghosts.
template <int D>
void begin_with_simplex(triangulation<D>& t, const box_predicates<D>& predicates) {
  constexpr auto corners = static_cast<std::size_t>(D) + 1;
  typename triangulation<D>::cell first{};
  for (std::size_t i = 0; i < corners; ++i)
    first.vertices[i] = static_cast<local_id>(i);
  t.cells.assign(1, first);
  if (predicates.orientation(t.points_of(0)) < 0)
    std::swap(t[0].vertices[0], t[0].vertices[1]);
  // Ghost i + 1 has the infinite vertex in place of vertex i, and two others exchanged to face outwards.
  for (std::size_t i = 0; i < corners; ++i) {
    auto ghost = t[0];
    ghost.vertices[i] = triangulation<D>::infinite;
    std::swap(ghost.vertices[(i + 1) % corners], ghost.vertices[(i + 2) % corners]);
    t.cells.push_back(ghost);
  }
  // Across the side opposite v lies, from each ghost, the ghost that lacks v; from the simplex as well.
  const auto place_of_vertex = [&](local_id e, local_id v) {
    local_id i = 0;
    while (t[e].vertices[i] != v)
      ++i;
    return i;
  };
  for (std::size_t i = 0; i < corners; ++i) {
    const auto ghost = static_cast<local_id>(i) + 1;
    t.join(triangulation<D>::side_of(0, static_cast<local_id>(i)),
           triangulation<D>::side_of(ghost, place_of_vertex(ghost, triangulation<D>::infinite)));
    for (std::size_t k = i + 1; k < corners; ++k) {
      const auto other = static_cast<local_id>(k) + 1;
      t.join(triangulation<D>::side_of(ghost, place_of_vertex(ghost, t[0].vertices[k])),
             triangulation<D>::side_of(other, place_of_vertex(other, t[0].vertices[i])));
    }
  }
}

} // namespace dovetail::detail
