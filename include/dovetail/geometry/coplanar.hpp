/// @file
/// Whether two planes are the same.
#pragma once

#include "dovetail/geometry/concepts.hpp"

#include <cmath>

namespace dovetail {

/// Whether two planes have the same normal but for its sign, and the points of both frames are in both.
/// \param tolerance of the sine of the angle between them, and of lengths as a share of `extent`
/// \param extent a length, as that of the model's diagonal
inline bool are_coplanar(const surface_frame& a, const surface_frame& b, double extent, double tolerance) {
  const vec3 n = normalized(cross(a.du, a.dv)), m = normalized(cross(b.du, b.dv));
  return norm(cross(n, m)) < tolerance && std::abs(dot(n, b.point - a.point)) < tolerance * extent;
}

} // namespace dovetail
