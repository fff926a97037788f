/// @file
/// What `predicates.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/core/vector.hpp"

namespace dovetail {

namespace detail {

DOVETAIL_INLINE double orient2d_exact(vec2 a, vec2 b, vec2 c) {
  return exact_sign<4>({b.x, b.y, c.x, c.y}, {a.x, a.y, a.x, a.y},
                       [](const auto& n) { return plane_determinant(n); });
}

DOVETAIL_INLINE double orient3d_exact(vec3 a, vec3 b, vec3 c, vec3 d) {
  return exact_sign<9>({b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z},
                       {a.x, a.y, a.z, a.x, a.y, a.z, a.x, a.y, a.z},
                       [](const auto& n) { return space_determinant(n); });
}

DOVETAIL_INLINE double in_circle_exact(vec2 a, vec2 b, vec2 c, vec2 d) {
  return exact_sign<6>({a.x, a.y, b.x, b.y, c.x, c.y}, {d.x, d.y, d.x, d.y, d.x, d.y},
                       [](const auto& n) { return circle_determinant(n); });
}

DOVETAIL_INLINE double in_sphere_exact(vec3 a, vec3 b, vec3 c, vec3 d, vec3 e) {
  return exact_sign<12>({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z},
                        {e.x, e.y, e.z, e.x, e.y, e.z, e.x, e.y, e.z, e.x, e.y, e.z},
                        [](const auto& n) { return sphere_determinant(n); });
}

} // namespace detail

} // namespace dovetail
