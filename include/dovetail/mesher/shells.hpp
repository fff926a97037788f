/// @file
/// The shells of an oriented boundary: outer ones, and the voids inside each.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// One connected body inside a boundary.
struct bounded_body {
  std::vector<simplex<2>> outer;              ///< oriented outwards
  std::vector<std::vector<simplex<2>>> voids; ///< its voids, each a closed shell
};

/// Groups of triangles connected across edges, by lowest triangle; every triangle is in exactly one.
std::vector<std::vector<simplex<2>>> edge_connected_shells(std::span<const simplex<2>> triangles,
                                                           std::size_t point_count);

/// How often a closed shell winds around a point that is not on it: 1 inside an outer shell, 0 outside. The
/// sum of the triangles' solid angles (van Oosterom and Strackee).
double winding_number(std::span<const vec3> points, std::span<const simplex<2>> shell, vec3 p);

/// The bodies of a boundary without inner interfaces. Shells that enclose a positive volume are outer; each
/// other one is a void of the smallest outer shell around it. Throws `mesher_error` for a void in no body.
/// Linear in the triangles, times the number of voids.
std::vector<bounded_body> bodies_of(const simplicial_mesh<2>& boundary);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/shells.ipp"
#endif
