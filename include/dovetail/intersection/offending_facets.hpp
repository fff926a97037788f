/// @file
/// A file that shows why a boundary could not be meshed.
#pragma once

#include "dovetail/core/output_file.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

namespace dovetail {

/// The triangles of a boundary that cross another one, by growing index. Exact. Triangles listed in both
/// directions do not cross each other.
/// O(n log n) for triangles of bounded overlap. Throws nothing but for a lack of memory.
/// \param boundary triangles
std::vector<local_id> crossing_facets(const simplicial_mesh<2>& boundary);

/// Writes triangles of a boundary, with the points they use, as an OFF file. Throws `io_error`.
/// Linear.
/// \param boundary triangles
/// \param facets numbers of the triangles to write
/// \param path the file, which is replaced
void write_facets(const simplicial_mesh<2>& boundary, const std::vector<local_id>& facets,
                  const std::filesystem::path& path);

/// Writes the triangles that cross others, or the whole boundary when none does; returns how many cross.
/// O(n log n). Throws `io_error`.
/// \param boundary triangles
/// \param path the file, which is replaced
std::size_t write_offending_facets(const simplicial_mesh<2>& boundary, const std::filesystem::path& path);

/// For `meshing_options::on_failure`: writes the offending facets of each failed subdomain to `folder`, which
/// is made when the first one fails. An empty folder: nothing is written.
/// O(n log n) for each failed subdomain. What it returns throws `io_error`.
/// \param folder where files go
std::function<void(piece_failure&, const simplicial_mesh<2>&)>
write_facets_of_failures(std::filesystem::path folder);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/intersection/offending_facets.ipp"
#endif
