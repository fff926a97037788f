/// @file
/// A mesh from a file made ready for an improver, and put back with all that the file said of it.
#pragma once

#include "dovetail/improver/concepts.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <array>
#include <string>
#include <vector>

namespace dovetail::app {

/// Takes the mesh of a file apart: what must stay is frozen, and, where the file numbers points or has
/// triangles beside tetrahedra, points that stay come first. These are the points of the boundary, of
/// interfaces of materials and, for D = 3, of subdomains and of triangles in the file.
template <int D>
class improvable_mesh {
public:
  explicit improvable_mesh(io::loaded_mesh from);

  simplicial_mesh<D> mesh;
  frozen_entities<D> frozen;

  /// The mesh as it is now with the rest of the file: triangles, groups, names, subdomains; points that
  /// stayed have their numbers, the others the least that are free. Without values of points, and without
  /// points that no element uses.
  io::loaded_mesh put_back() &&;

private:
  void join_subdomains();
  void freeze_interfaces();
  void bring_forward(std::vector<bool> stays);

  io::loaded_mesh rest_;
  /// Per tag of `mesh`, where elements have subdomains: their material and subdomain.
  std::vector<std::array<local_id, 2>> material_and_subdomain_;
};

/// What is not in the file that `improvable_mesh` makes, in words; empty when all is.
std::string left_out(const io::loaded_mesh& mesh);

} // namespace dovetail::app
