/// @file
/// Nearest points on segments and triangles in barycentric coordinates.
#pragma once

#include "dovetail/core/vector.hpp"

#include <array>

namespace dovetail {

/// Barycentric coordinates of the point of segment (a, b) nearest to p; a degenerate segment is its first
/// point.
std::array<double, 2> nearest_on_segment(vec3 a, vec3 b, vec3 p);

/// Barycentric coordinates of the point of triangle (a, b, c) nearest to p, by the Voronoi regions of its
/// corners and edges (Ericson, Real-Time Collision Detection, 5.1.5). A degenerate triangle falls back to its
/// edges.
std::array<double, 3> nearest_on_triangle(vec3 a, vec3 b, vec3 c, vec3 p);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/nearest_point.ipp"
#endif
