/// @file
/// Reads VTU files, PVTU files with all their pieces, and the triangles of VTP files.
#pragma once

#include "dovetail/core/xml_tree.hpp"
#include "dovetail/files/vtk_arrays.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <filesystem>
#include <vector>

namespace dovetail::io {

namespace detail {

/// The files that a PVTU file names. Throws `input_error`.
std::vector<std::filesystem::path> pvtu_sources(const std::filesystem::path& file, const xml_element& root);

} // namespace detail

/// Reads VTU, PVTU and VTP files: tetrahedra, triangles, scalar point arrays, and the cell arrays `region`
/// (or `material`, `gmsh:physical`, `CellEntityIds`) and `subdomain`. Vertices and lines are passed over, and
/// so are cells that are ghosts. Points of different files are merged, and in one file those of the same
/// `GlobalNodeIds` at the same place.
///
/// With `fields` also point arrays of several components, and all cell arrays but those that say what a cell
/// is a part of or which number it has (`region`, `subdomain`, `GlobalCellIds` and the like). Then it refuses
/// an array that is there twice, or in some pieces only.
struct vtu_reader {
  vtk_expander expand = nullptr; ///< of compressed arrays: `zlib_expand`, or null when there are none
  bool fields = false;           ///< whether to read `point_fields` and `element_fields`
  element_order elements = element_order::first; ///< which elements to take

  loaded_mesh operator()(const std::filesystem::path& file) const;
};

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/vtu_reader.ipp"
#endif
