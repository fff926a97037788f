/// @file
/// Writes a mesh held in memory to an MSH file.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/files/mesh_document.hpp"

#include <filesystem>

namespace dovetail::io {

namespace detail {

void write_msh_document(const mesh_document& mesh, const std::filesystem::path& path, bool binary);

} // namespace detail

/// Writes an MSH 4.1 file with one entity and one physical group per tag: group and entity t + 1 for tag t.
/// `names` are names of tags. Points are filed under the first tag that uses them. Throws `io_error` naming
/// the path, `mesh_error` when the tags are not one per element or negative.
/// About linear.
/// \param mesh triangles or tetrahedra with tags; or what a reader read
/// \param path the file, which is replaced
/// \param names of tags, as physical names
/// \param binary false: text
template <int D>
void write_msh(const simplicial_mesh<D>& mesh, const std::filesystem::path& path, const tag_names& names = {},
               bool binary = true) {
  detail::write_msh_document(detail::document_of(mesh, names), path, binary);
}
/// All that was read, but point arrays: also triangles with their groups, subdomains as partitions, and the
/// numbers of nodes.
inline void write_msh(const loaded_mesh& mesh, const std::filesystem::path& path, bool binary = true) {
  detail::write_msh_document(detail::document_of(mesh), path, binary);
}

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/write_msh.ipp"
#endif
