/// @file
/// What must be so of a mesh, and of sides or edges with ids, for its boundary to be found.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/mesh/validity.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail::detail {

/// Throws `mesh_error` when elements cannot be told from each other's inside and outside.
template <int D>
void require_boundary_to_find(const simplicial_mesh<D>& mesh) {
  if (mesh.elements.empty())
    throw mesh_error(std::string("the mesh has no ") + (D == 3 ? "tetrahedron" : "triangle") +
                     ": there is nothing to adapt");
  const auto found =
      check_validity(mesh, {.closed_boundary = false, .non_manifold_sides = D == 2, .isolated_points = true});
  if (!found.valid())
    throw mesh_error("the mesh is not valid, so that its boundary cannot be found: " + found.text());
}

/// Throws `mesh_error` unless sides or edges have points of the mesh, and one id each that is not negative.
template <int D>
void require_ids(const std::vector<vec3>& points, const std::vector<simplex<D>>& sides,
                 const std::vector<local_id>& ids, const std::string& side) {
  if (sides.size() != ids.size())
    throw mesh_error("there are " + std::to_string(sides.size()) + " " + side + "s and " +
                     std::to_string(ids.size()) + " ids; give one id per " + side);
  for (std::size_t s = 0; s < ids.size(); ++s) {
    if (ids[s] < 0 && ids[s] != no_id)
      throw mesh_error(side + " " + std::to_string(s) + " has the id " + std::to_string(ids[s]) +
                       "; ids are not negative");
    for (const local_id v : sides[s])
      if (v < 0 || static_cast<std::size_t>(v) >= points.size())
        throw mesh_error(side + " " + std::to_string(s) + " has the point " + std::to_string(v) +
                         ", which does not exist");
  }
}

} // namespace dovetail::detail
