/// @file
/// Reads a mesh of any format that is known, which is told from the file's first bytes.
#pragma once

#include "dovetail/files/vtk_arrays.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dovetail::io {

/// The PVTU and MSH files of a folder, in this order and by name: each may be a mesh, or a part of one.
std::vector<std::filesystem::path> mesh_files_in(const std::filesystem::path& folder);

/// The mesh file that is meant: of a folder, the PVTU or MSH file in it, or where there are several that of
/// dovetail's own names. Throws `input_error`, also where the files of a folder may be different meshes.
std::filesystem::path find_mesh_file(const std::filesystem::path& path);

/// Reads a VTU, PVTU, VTP or MSH file; of a folder, the PVTU or MSH file in it. Of an MSH file that has one
/// part of a mesh, as those of `msh-ranks`, reads the whole, from the files of all parts (`files` in the
/// result). `expand` is for compressed arrays, see `vtu_reader`. Throws `input_error` naming the file and
/// what is wrong with it; so it is with a VTU file that a PVTU file beside it names as one of several, which
/// `vtu_reader` reads by itself.
/// Linear in the files.
/// \param path a file, or a folder with one
/// \param expand expands compressed arrays, or none
/// \param fields whether all fields of VTU, PVTU and VTP files are read, as `vtu_reader` says
/// \param elements whether elements of second order are taken
loaded_mesh read_mesh(const std::filesystem::path& path, vtk_expander expand = nullptr, bool fields = false,
                      element_order elements = element_order::first);

/// The files that `read_mesh` reads: of a PVTU file its pieces too, of an MSH file of one part those of all
/// parts. Throws `input_error`.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path);

/// Of a mesh that was read from one VTU or PVTU file with dovetail's arrays: in words, that it lacks points
/// of the mesh whose numbers it has; empty: it does not.
std::string points_elsewhere(const loaded_mesh& mesh);
/// The same of `points` points with numbers up to `highest`.
std::string points_elsewhere(std::uint64_t points, global_id highest);

/// Calls `f(piece, file)` for each VTU file of a PVTU file, and each MSH file of a mesh in parts, one in
/// memory at a time, its points merged and in the order of their global numbers. False when that is not
/// possible, after any number of calls: for other files, and for pieces without tetrahedra or without global
/// numbers. Throws what `read_mesh` throws.
bool for_each_piece_file(const std::filesystem::path& path, vtk_expander expand,
                         const std::function<void(const loaded_mesh&, const std::filesystem::path&)>& f,
                         element_order elements = element_order::first);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/read_mesh.ipp"
#endif
