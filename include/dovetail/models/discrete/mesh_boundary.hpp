/// @file
/// The surfaces that a mesh ends at, and that its materials meet at, as what geometry models are made of.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/models/discrete/oriented_surfaces.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace dovetail {

/// The body that a mesh of tetrahedra fills. Each connected part of a material is a solid of its own.
struct mesh_boundary {
  oriented_surfaces surfaces;              ///< groups: the ids of sides, which are their names too
  std::vector<local_id> material_of_solid; ///< the tag of its tetrahedra
};

/// The boundary of a mesh and of its materials (`mesh.tags`). `given` are sides with ids, in any orientation;
/// those inside a material do not count, which a warning tells, and sides that are not given have no id.
/// O(n log n). Throws `mesh_error` for a mesh without elements or with faults, and when ids are negative or
/// not one per side, or a side has a point that does not exist.
mesh_boundary boundary_of(const simplicial_mesh<3>& mesh, const std::vector<simplex<2>>& given,
                          const std::vector<local_id>& ids);

/// A mesh of triangles as a surface: its tags are ids. Where edges with ids (`given`, in any orientation)
/// meet others, its curves have a corner. Throws `mesh_error` for one that is empty, and when ids are
/// negative or not one per edge; `geometry_error` where it has one side only.
oriented_surfaces surface_of(const simplicial_mesh<2>& mesh, const std::vector<simplex<1>>& given = {},
                             const std::vector<local_id>& ids = {});

/// Finds the ids of edges again on a model whose curves they make up.
class edge_ids {
public:
  edge_ids(const std::vector<vec3>& points, const std::vector<simplex<1>>& edges, std::vector<local_id> ids);

  /// The id of the edge nearest to a point, which counts as met; no_id where none is within `nearness` of its
  /// length. O(log edges).
  local_id at(vec3 p, double nearness = 1e-6);
  /// Edges that no point was at.
  std::size_t missed() const;

private:
  std::vector<local_id> ids_;
  std::vector<bool> met_;
  std::vector<std::array<vec3, 2>> ends_;
  box_tree tree_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/discrete/mesh_boundary.ipp"
#endif
