/// @file
/// How well a triangle is shaped, as a part of an oriented surface.
#pragma once

#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::detail {

/// sin^2 of the smallest angle of a triangle (0.75 when equilateral, 0 when degenerate) where its normal
/// agrees with the given surface normal direction (any length), otherwise a negative number that grows with
/// the agreement.
inline double oriented_quality(vec3 a, vec3 b, vec3 c, vec3 normal) {
  constexpr double least_cosine = 0.15;
  const vec3 ab = b - a, bc = c - b, ca = a - c;
  const vec3 area = cross(ab, bc);
  const double x = norm_squared(ab), y = norm_squared(bc), z = norm_squared(ca);
  const double two_longest = std::max({x * y, y * z, z * x});
  if (!(two_longest > 0))
    return -1;
  const double area_squared = norm_squared(area);
  const double along = dot(area, normal);
  const double full = area_squared * norm_squared(normal);
  if (along > 0 && along * along >= least_cosine * least_cosine * full)
    return area_squared / two_longest;
  return full > 0 ? along / std::sqrt(full) - 1 : 0.0;
}

/// The same in a plane that is seen from the tip of its normal.
inline double oriented_quality(vec2 a, vec2 b, vec2 c) {
  const vec2 ab = b - a, bc = c - b, ca = a - c;
  const double area = cross(ab, bc);
  const double x = dot(ab, ab), y = dot(bc, bc), z = dot(ca, ca);
  const double two_longest = std::max({x * y, y * z, z * x});
  if (!(two_longest > 0))
    return -1;
  return area > 0 ? area * area / two_longest : area < 0 ? -2 : 0;
}

} // namespace dovetail::detail
