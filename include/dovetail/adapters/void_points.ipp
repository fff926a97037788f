/// @file
/// What `void_points.hpp` declares.
#pragma once

#include "dovetail/adapters/void_points.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/shells.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace dovetail {

namespace detail {

/// Distance along the ray to a triangle, or infinity. Hits within 1e-9 outside the triangle count, so that a
/// ray through an edge hits.
inline double ray_hit(vec3 from, vec3 direction, vec3 a, vec3 b, vec3 c) {
  constexpr double miss = std::numeric_limits<double>::infinity();
  constexpr double margin = 1e-9;
  const vec3 p = cross(direction, c - a);
  const double determinant = dot(b - a, p);
  if (determinant == 0)
    return miss;
  const double u = dot(from - a, p) / determinant;
  const vec3 q = cross(from - a, b - a);
  const double v = dot(direction, q) / determinant;
  const double t = dot(c - a, q) / determinant;
  return u >= -margin && v >= -margin && u + v <= 1 + margin && t > 0 ? t : miss;
}

} // namespace detail

DOVETAIL_INLINE std::vector<vec3> points_in_voids(const simplicial_mesh<2>& boundary) {
  const boundary_sides sides(boundary.elements);
  std::vector<simplex<2>> to_outside;
  for (const auto& triangle : boundary.elements) {
    const auto& listed = sides.entries()[sides.find(triangle).entry].listed;
    if (listed[0] == no_id || listed[1] == no_id)
      to_outside.push_back(triangle);
  }
  const auto at = [&](local_id v) { return boundary.points[v]; };
  std::vector<vec3> points;
  for (const auto& shell : edge_connected_shells(to_outside, boundary.points.size())) {
    if (!(enclosed_volume(boundary.points, shell) < 0))
      continue;
    simplex<2> largest{};
    vec3 normal{};
    for (const auto& t : shell) {
      const vec3 area = cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
      if (norm_squared(area) > norm_squared(normal)) {
        normal = area;
        largest = t;
      }
    }
    const vec3 middle = (at(largest[0]) + at(largest[1]) + at(largest[2])) / 3.0;
    normal = normalized(normal);
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& t : boundary.elements)
      if (t != largest)
        nearest = std::min(nearest, detail::ray_hit(middle, normal, at(t[0]), at(t[1]), at(t[2])));
    if (nearest < std::numeric_limits<double>::infinity())
      points.push_back(middle + (nearest / 2) * normal);
  }
  return points;
}

} // namespace dovetail
