/// @file
/// What the writers of meshes held in memory take.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

/// Names of tags.
using tag_names = std::vector<std::pair<local_id, std::string>>;

namespace detail {

/// What the writers of VTU and MSH take: tetrahedra, triangles or both, on one set of points. What a mesh
/// does not have is empty.
struct mesh_document {
  std::span<const vec3> points;
  std::span<const global_id> ids = {};
  std::span<const simplex<3>> tetrahedra = {};
  std::span<const local_id> materials = {};
  std::span<const local_id> subdomains = {};
  std::span<const simplex<2>> triangles = {};
  std::span<const local_id> groups = {};
  tag_names material_names = {};
  tag_names group_names = {};
};

/// Throws `mesh_error` when there is not one tag per element.
template <int D>
mesh_document document_of(const simplicial_mesh<D>& mesh, const tag_names& names) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesh_error("the mesh does not have one tag per element");
  mesh_document document{.points = mesh.points};
  if constexpr (D == 3) {
    document.tetrahedra = mesh.elements;
    document.materials = mesh.tags;
    document.material_names = names;
  } else {
    static_assert(D == 2, "meshes of triangles and of tetrahedra are written");
    document.triangles = mesh.elements;
    document.groups = mesh.tags;
    document.group_names = names;
  }
  return document;
}
mesh_document document_of(const loaded_mesh& mesh);
} // namespace detail

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/mesh_document.ipp"
#endif
