/// @file
/// How points inside a piece are spaced.
#pragma once

namespace dovetail {

/// Lengths are in sizes. The defaults were chosen by trials on pieces of an airliner with uniform and graded
/// sizes: fewest slivers and lost boundary triangles, and a mean edge of one size.
struct interior_point_options {
  /// Edge of the lattice's cubes. Of the seven edges per point four are sqrt(3)/2 of it and three as long:
  /// the mean is 0.9235 of it, which is a little less than the size, for edges to the boundary come out
  /// longer.
  double cell = 1.055;
  double crowding = 0.68;  ///< least distance between points
  double capture = 0.42;   ///< places that close that two neighbours expect a point at are the same place
  double clearance = 0.57; ///< least distance from the boundary, less than 1
  /// Sizes that grow by more per length, also away from boundary triangles, are made smaller: no lattice can
  /// follow them.
  double steepest = 0.4;
  /// How far places of the lattice are moved, each its own way: Delaunay's test is exact, and slow for points
  /// that are on one sphere.
  double jitter = 1e-3;
  /// More are refused with a `mesher_error`. Of six elements each, so many are as many as have numbers.
  double most_points = 8e7;
};

} // namespace dovetail
