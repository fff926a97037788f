/// @file
/// What `frame.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/geometry/frame.hpp"

#include <cmath>
#include <cstddef>

namespace dovetail::discrete {

DOVETAIL_INLINE chart_frame frame_along(vec3 origin, vec3 normal) {
  const vec3 n = normalized(normal);
  const vec3 size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  const vec3 axis = size.x <= size.y && size.x <= size.z ? vec3{1, 0, 0}
                    : size.y <= size.z                   ? vec3{0, 1, 0}
                                                         : vec3{0, 0, 1};
  const vec3 u = normalized(axis - dot(axis, n) * n);
  return {origin, u, cross(n, u), n};
}

DOVETAIL_INLINE vec3 vector_moments::principal_axis() const {
  const vec3 m = mean();
  vec3 axis = normalized({0.5773, 0.6131, 0.5391});
  for (int step = 0; step < 64; ++step) {
    vec3 next;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        next[i] += (squares_[3 * i + j] - weight_ * m[i] * m[j]) * axis[j];
    if (!(norm(next) > 0))
      return axis;
    axis = normalized(next);
  }
  return axis;
}

} // namespace dovetail::discrete
