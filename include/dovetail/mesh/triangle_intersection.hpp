/// @file
/// Do two triangles of one mesh cross? Decided exactly; vertices that the two share are treated
/// combinatorially, so that neighbours in a valid mesh never count as crossing.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <span>

namespace dovetail {

namespace detail {

inline int sign_of(double value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// Closed segments pq and ab of the plane, possibly collinear.
bool segments_meet(vec2 p, vec2 q, vec2 a, vec2 b);

} // namespace detail

/// True when the triangles have a point in common beyond the vertices and edges they share by index. Touching
/// counts; so does the same triangle twice.
bool triangles_cross(std::span<const vec3> points, const simplex<2>& s, const simplex<2>& t);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/triangle_intersection.ipp"
#endif
