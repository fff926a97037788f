/// @file
/// The mesh that all stages pass to each other: flat arrays, no hidden state.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <cstdint>
#include <vector>

namespace dovetail {

/// The geometric entity that a mesh entity lies on: its dimension (0 vertex, 1 curve, 2 face, 3 solid) and
/// the entity's index within that dimension.
struct host {
  std::int32_t dimension = 3; ///< 3 also says that it lies on nothing in particular, inside a solid
  local_id id = no_id;        ///< of the entity; no_id where there is none

  friend constexpr bool operator==(const host&, const host&) = default;
  friend constexpr auto operator<=>(const host&, const host&) = default;
};

/// D-simplices in 3-space.
template <int D>
struct simplicial_mesh {
  std::vector<vec3> points;         ///< by their number; an element names them
  std::vector<simplex<D>> elements; ///< positively oriented (D = 3) or along the host's normal (D = 2)
  std::vector<local_id>
      tags; ///< per element: material (D = 3), CAD face (D = 2), CAD curve (D = 1); or empty

  using fields = field_list<&simplicial_mesh::points, &simplicial_mesh::elements, &simplicial_mesh::tags>;
};

/// A triangulation of CAD faces, conforming across their curves. `mesh.tags` are CAD faces.
/// A triangle is oriented along the parametric normal of its face's *oriented* surface, that is outwards for
/// a face used by one solid.
struct surface_mesh {
  simplicial_mesh<2> mesh;                    ///< points, triangles and their faces
  std::vector<std::array<vec2, 3>> corner_uv; ///< per triangle and corner: parameters on the CAD face
  std::vector<host> vertex_hosts;             ///< per point: the lowest-dimensional CAD entity it lies on

  /// A mesh edge that lies on a CAD curve.
  struct curve_edge {
    std::array<local_id, 2> vertices; ///< in the direction of growing curve parameter
    local_id curve;                   ///< the number of the curve in the model
    std::array<double, 2> t;          ///< curve parameters of the two vertices
  };
  std::vector<curve_edge> curve_edges; ///< all of them, each edge once

  using fields = field_list<&surface_mesh::mesh, &surface_mesh::corner_uv, &surface_mesh::vertex_hosts,
                            &surface_mesh::curve_edges>;
};

} // namespace dovetail
