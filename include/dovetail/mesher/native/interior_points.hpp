/// @file
/// The points inside a piece, made before any element is.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/mesher/native/interior_point_options.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <vector>

namespace dovetail {

/// Points inside oriented shells such that the Delaunay tetrahedrization of the boundary's points and these
/// has nearly all boundary triangles in it, edges as long as the size says, and few slivers. A body-centred
/// cubic lattice, the best there is for Delaunay tetrahedra (Labelle and Shewchuk, Isosurface stuffing, 2007,
/// doi:10.1145/1276377.1276448): straight where the size is the same everywhere, else grown from where sizes
/// are small (see lattice_growth.hpp), kept clear of the boundary and of the smallest balls around its
/// triangles.
///
/// `boundary`: closed shells, outer ones oriented outwards, voids into the void; edges with more than two
/// triangles and triangles listed in both directions are as good as others. Empty where the piece is thinner
/// than about one size.
///
/// The same input gives the same bits, whatever the order of the triangles. The mean Delaunay edge is the
/// size within 6 % (fields of slopes 0 to 0.25). About linear in the points and the triangles; the field is
/// asked 1 to 2 times per point, at corners of an octree, moved into the box of the boundary, and in the
/// middle of each triangle. Thread-safe.
///
/// Throws `mesher_error` for a boundary that is not closed or encloses nothing (`require_enclosing`), or when
/// there would be more points than the options allow; `sizing_error` when a size is not positive and finite.
std::vector<vec3> interior_points(const simplicial_mesh<2>& boundary, const any_sizing& size,
                                  const interior_point_options& options = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/native/interior_points.ipp"
#endif
