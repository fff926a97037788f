/// @file
/// A point that sees the whole boundary of a small region from inside.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace dovetail::detail {

/// A point in front of the planes of all triangles, as far as can be from the nearest of them, found by
/// going, in steps that get smaller, away from whichever is nearest (the subgradient method). Where there is
/// no such point the result is any point.
inline vec3 point_before_all(std::span<const std::array<vec3, 3>> triangles) {
  constexpr int steps = 400;
  std::vector<vec3> normals;
  box3 box;
  vec3 p{};
  for (const auto& t : triangles) {
    normals.push_back(normalized(cross(t[2] - t[0], t[1] - t[0])));
    for (const vec3 corner : t) {
      box.include(corner);
      p += corner / (3.0 * static_cast<double>(triangles.size()));
    }
  }
  vec3 best = p;
  double best_distance = -1e300;
  for (int step = 0; step < steps; ++step) {
    double distance = 1e300;
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < triangles.size(); ++k)
      if (const double d = dot(normals[k], p - triangles[k][0]); d < distance) {
        distance = d;
        nearest = k;
      }
    if (distance > best_distance) {
      best_distance = distance;
      best = p;
    }
    constexpr double first_step = 0.2; // over the size of the region
    p += (first_step * box.diagonal() / (1 + 0.3 * step)) * normals[nearest];
  }
  return best;
}

/// Adds to `fresh` the elements between a new point and `sides`, which close a region and are oriented
/// outwards of it. False, and nothing is added, when no point was found that sees them all.
inline bool add_star(local_changes& changes, std::span<const simplex<2>> sides,
                     std::vector<simplex<3>>& fresh, std::size_t& added) {
  std::vector<std::array<vec3, 3>> triangles;
  for (const auto& [a, b, c] : sides) {
    if (a < 0 || b < 0 || c < 0)
      return false;
    triangles.push_back({changes.point(a), changes.point(b), changes.point(c)});
  }
  const std::size_t points = changes.mesh().points.size();
  const local_id s = changes.add_point(point_before_all(triangles));
  for (const auto& [a, b, c] : sides)
    if (!changes.is_positive({s, a, b, c})) {
      changes.drop_points(points);
      return false;
    }
  for (const auto& [a, b, c] : sides)
    fresh.push_back({s, a, b, c});
  ++added;
  return true;
}

} // namespace dovetail::detail
