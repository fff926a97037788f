/// @file
/// Writes a mesh held in memory to a VTU file.
#pragma once

#include "dovetail/files/mesh_document.hpp"

#include <filesystem>
#include <vector>

namespace dovetail::io {

namespace detail {

void write_vtu_document(const mesh_document& mesh, const std::filesystem::path& path,
                        const std::vector<point_array>& arrays, const std::vector<mesh_field>& at_points = {},
                        const std::vector<mesh_field>& in_elements = {});

} // namespace detail

/// Writes a VTU file with cell data `region` (the tags, where there are any), their names as field data
/// `region_names`, and the given point arrays, of one value per point. Throws `io_error` naming the path,
/// `mesh_error` when the tags are not one per element.
/// Linear.
/// \param mesh triangles or tetrahedra with tags, or without
/// \param path the file, which is replaced
/// \param arrays a name and one value per point each
/// \param names what tags are called
template <int D>
void write_vtu(const simplicial_mesh<D>& mesh, const std::filesystem::path& path,
               const std::vector<point_array>& arrays = {}, const tag_names& names = {}) {
  detail::write_vtu_document(detail::document_of(mesh, names), path, arrays);
}
/// All that was read: also point data `GlobalNodeIds`, cell data `subdomain`, and triangles with cell data
/// `patch` (groups) and field data `patch_names` (where there are no tetrahedra: `region`). A cell that an
/// array says nothing of has -1 there, and in fields NaN.
inline void write_vtu(const loaded_mesh& mesh, const std::filesystem::path& path) {
  detail::write_vtu_document(detail::document_of(mesh), path, mesh.point_scalars, mesh.point_fields,
                             mesh.element_fields);
}

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/write_vtu.ipp"
#endif
