/// @file
/// Constrained Delaunay triangulation of a plane domain given by closed loops.
///
/// The points are made a Delaunay triangulation; missing segments are recovered by flips (S. W. Sloan, "A
/// fast algorithm for generating constrained Delaunay triangulations", doi 10.1016/0045-7949(93)90239-A); the
/// outside is removed by winding number. All decisions are exact.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/corner_table.hpp"

#include <array>
#include <span>
#include <vector>

namespace dovetail {

/// What `triangulate_loops` found. `table` is a triangulation of the domain exactly when `valid()`.
struct loop_triangulation {
  corner_table table;            ///< vertices are the given points; constraints are segment indices
  std::vector<local_id> same_as; ///< per point: the point of lowest index with the same coordinates
  std::vector<std::array<local_id, 2>> crossings; ///< pairs of segments that cross, touch or overlap
  std::vector<local_id> misplaced; ///< segments that have the domain on their wrong side: a loop runs
                                   ///< backwards or lies inside another one of its kind

  /// Whether it has all segments and no misplaced point.
  bool valid() const { return crossings.empty() && misplaced.empty(); }
};

/// Triangulates the domain to the left of closed loops of segments over `points`. Every segment is a side of
/// the result; a segment passed once in each direction (a slit) has the domain on both sides. Crossing,
/// touching or overlapping segments and wrongly oriented loops are reported, never triangulated wrongly.
/// Complexity: about n log n.
/// Throws nothing but for a lack of memory: faults are data.
/// \param points coordinates in the plane
/// \param segments pairs of indices of points
loop_triangulation triangulate_loops(std::span<const vec2> points,
                                     std::span<const std::array<local_id, 2>> segments);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/constrained_triangulation.ipp"
#endif
