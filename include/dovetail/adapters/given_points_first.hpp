/// @file
/// Puts the points that a mesher was given back in front, in their order, after it renumbered them.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <vector>

namespace dovetail {

/// The mesh of `points` and `elements`, renumbered: first `given`, found by exact coordinates, then the
/// others in their order. A given point that is not among `points` is in no element. O(n log n). Throws
/// `mesher_error` when two given points coincide.
simplicial_mesh<3> with_given_points_first(const std::vector<vec3>& given, const std::vector<vec3>& points,
                                           std::vector<simplex<3>> elements);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/adapters/given_points_first.ipp"
#endif
