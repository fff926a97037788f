/// @file
/// Which ids and materials of a mesh the faces, solids and curves of a model have: found by place, for a mesh
/// that is made anew on the model that it is a mesh of.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/models/discrete/mesh_boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace dovetail {

/// The numbers of a mesh that the entities of a model have.
struct model_names {
  std::vector<local_id> id_of_face;        ///< by face or curve of the model
  std::vector<local_id> material_of_solid; ///< D = 3
  std::vector<local_id> id_of_curve;       ///< D = 2
  std::vector<std::string> warnings;       ///< what the report is to tell
};

namespace detail {

/// The triangle of a surface that is nearest to a point, of those that face the same way.
class facing_triangles {
public:
  explicit facing_triangles(const simplicial_mesh<2>& mesh);

  struct found {
    std::size_t triangle = 0;
    double distance = std::numeric_limits<double>::infinity();
  };
  /// `either_way`: triangles that face the other way will do.
  found nearest(vec3 p, vec3 normal, bool either_way) const;
  double longest_edge(std::size_t t) const {
    const auto [a, b, c] = corners(t);
    return std::max({distance(a, b), distance(b, c), distance(c, a)});
  }
  double mean_longest_edge() const;

private:
  vec3 point(local_id v) const { return mesh_->points[v]; }
  std::array<vec3, 3> corners(std::size_t t) const {
    const auto& v = mesh_->elements[t];
    return {point(v[0]), point(v[1]), point(v[2])};
  }

  const simplicial_mesh<2>* mesh_;
  box_tree tree_;
};

/// Points of the model's faces, spread over the triangles of a coarse surface on them.
struct face_sample {
  local_id face;
  vec3 point, normal; ///< along the oriented face
  double area;        ///< that it stands for
};

/// Counts how much of a model is where the mesh has no boundary.
class strays {
public:
  void look(const face_sample& at, bool is_stray, double away);
  /// Throws `mesh_error` when that is more than what rounding of corners explains.
  void refuse_many(const geometry_topology& topology) const;

private:
  double all_ = 0, stray_ = 0, farthest_ = 0;
  local_id face_ = no_id;
  vec3 point_{};
};

/// Farther than half an edge of the mesh is not on its boundary.
inline bool is_stray(const facing_triangles& surface, const facing_triangles::found& found) {
  return !std::isfinite(found.distance) || found.distance > 0.5 * surface.longest_edge(found.triangle);
}

} // namespace detail

/// The ids of faces and materials of solids, by the `boundary` of a mesh of tetrahedra; `coarse` is a
/// triangulation of the model. O(n log n). Throws `mesh_error` when the mesh is not one of the model, and
/// when a face has parts of different ids, or a solid of different materials.
model_names names_on_model(const any_geometry& model, const surface_mesh& coarse,
                           const mesh_boundary& boundary);

/// The ids of faces and of curves, by a mesh of triangles with tags, and its edges with ids. O(n log n).
/// Throws `mesh_error` when the mesh is not one of the model, and when a face or curve has parts of different
/// ids. Of edges with ids that lie on no curve a warning tells.
model_names names_on_model(const any_geometry& model, const surface_mesh& coarse,
                           const simplicial_mesh<2>& mesh, const std::vector<simplex<1>>& edges,
                           const std::vector<local_id>& edge_ids_given);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/names_on_model.ipp"
#endif
