/// @file
/// What `triangle_intersection.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/mesh/simplex.hpp"
#include "dovetail/mesh/triangle_intersection.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace dovetail {

namespace detail {

inline vec2 drop_axis(vec3 p, int axis) {
  return axis == 0 ? vec2{p.y, p.z} : axis == 1 ? vec2{p.z, p.x} : vec2{p.x, p.y};
}

DOVETAIL_INLINE bool segments_meet(vec2 p, vec2 q, vec2 a, vec2 b) {
  const int pa = sign_of(orient2d(p, q, a)), pb = sign_of(orient2d(p, q, b));
  const int ap = sign_of(orient2d(a, b, p)), aq = sign_of(orient2d(a, b, q));
  if (pa == 0 && pb == 0) {
    const auto overlap = [](double s, double t, double u, double v) {
      return std::fmax(std::fmin(s, t), std::fmin(u, v)) <= std::fmin(std::fmax(s, t), std::fmax(u, v));
    };
    return overlap(p.x, q.x, a.x, b.x) && overlap(p.y, q.y, a.y, b.y);
  }
  return pa * pb <= 0 && ap * aq <= 0;
}

inline bool point_in_triangle(vec2 p, vec2 a, vec2 b, vec2 c) {
  const int ab = sign_of(orient2d(a, b, p)), bc = sign_of(orient2d(b, c, p)), ca = sign_of(orient2d(c, a, p));
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

inline bool coplanar_segment_meets_triangle(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c) {
  int axis = 0; // dropping it leaves the triangle an area
  while (axis < 2 && orient2d(drop_axis(a, axis), drop_axis(b, axis), drop_axis(c, axis)) == 0)
    ++axis;
  const vec2 p2 = drop_axis(p, axis), q2 = drop_axis(q, axis);
  const vec2 a2 = drop_axis(a, axis), b2 = drop_axis(b, axis), c2 = drop_axis(c, axis);
  return point_in_triangle(p2, a2, b2, c2) || segments_meet(p2, q2, a2, b2) ||
         segments_meet(p2, q2, b2, c2) || segments_meet(p2, q2, c2, a2);
}

/// Closed segment against closed triangle; touching counts.
inline bool segment_meets_triangle(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c) {
  const int above_p = sign_of(orient3d(a, b, c, p)), above_q = sign_of(orient3d(a, b, c, q));
  if (above_p * above_q > 0)
    return false;
  if (above_p == 0 && above_q == 0)
    return coplanar_segment_meets_triangle(p, q, a, b, c);
  const int ab = sign_of(orient3d(p, q, a, b)), bc = sign_of(orient3d(p, q, b, c)),
            ca = sign_of(orient3d(p, q, c, a));
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// Two triangles on a common edge (e, f) with apexes a and b overlap only when folded flat onto each other.
inline bool folded_on_edge(vec3 e, vec3 f, vec3 a, vec3 b) {
  if (orient3d(e, f, a, b) != 0)
    return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double side_a = orient2d(drop_axis(e, axis), drop_axis(f, axis), drop_axis(a, axis));
    const double side_b = orient2d(drop_axis(e, axis), drop_axis(f, axis), drop_axis(b, axis));
    if (side_a != 0 || side_b != 0)
      return side_a * side_b >= 0;
  }
  return true;
}

} // namespace detail

DOVETAIL_INLINE bool triangles_cross(std::span<const vec3> points, const simplex<2>& s, const simplex<2>& t) {
  std::array<int, 3> shared_in_s{}, shared_in_t{};
  int shared = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s[i] == t[j]) {
        shared_in_s[shared] = i;
        shared_in_t[shared++] = j;
      }
  const auto at = [&](local_id v) { return points[v]; };
  if (shared == 3)
    return true;
  if (shared == 2) {
    const int apex_s = 3 - shared_in_s[0] - shared_in_s[1], apex_t = 3 - shared_in_t[0] - shared_in_t[1];
    return detail::folded_on_edge(at(s[shared_in_s[0]]), at(s[shared_in_s[1]]), at(s[apex_s]), at(t[apex_t]));
  }
  const auto edge_of_s_meets_t = [&](int i) {
    return detail::segment_meets_triangle(at(s[i]), at(s[(i + 1) % 3]), at(t[0]), at(t[1]), at(t[2]));
  };
  const auto edge_of_t_meets_s = [&](int j) {
    return detail::segment_meets_triangle(at(t[j]), at(t[(j + 1) % 3]), at(s[0]), at(s[1]), at(s[2]));
  };
  // With one shared vertex the common part, a ray from it or an area, leaves one triangle through the edge
  // opposite.
  if (shared == 1)
    return edge_of_s_meets_t((shared_in_s[0] + 1) % 3) || edge_of_t_meets_s((shared_in_t[0] + 1) % 3);
  for (int i = 0; i < 3; ++i)
    if (edge_of_s_meets_t(i) || edge_of_t_meets_s(i))
      return true;
  return false;
}

} // namespace dovetail
