/// @file
/// What `mesh_document.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/files/mesh_document.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

namespace dovetail::io {

namespace detail {

DOVETAIL_INLINE mesh_document document_of(const loaded_mesh& mesh) {
  mesh_document document = document_of(mesh.mesh, mesh.material_names);
  document.ids = mesh.node_ids;
  document.subdomains = mesh.subdomains;
  document.triangles = mesh.triangles;
  document.groups = mesh.triangle_tags;
  document.group_names = mesh.triangle_names;
  return document;
}

} // namespace detail

} // namespace dovetail::io
