/// @file
/// Reads a mesh of any format that is known, which is told from the file's first bytes.
#pragma once

#include "dovetail/io/loaded_mesh.hpp"
#include "dovetail/io/vtk_arrays.hpp"

#include <filesystem>
#include <functional>
#include <vector>

namespace dovetail::io {

/// The mesh file that is meant: of a folder, the PVTU or MSH file in it. Throws `input_error`.
std::filesystem::path find_mesh_file(const std::filesystem::path& path);

/// Reads a VTU, PVTU, VTP or MSH file; of a folder, the PVTU or MSH file in it. `expand` is for compressed
/// arrays, see `vtu_reader`. Throws `input_error` naming the file and what is wrong with it.
loaded_mesh read_mesh(const std::filesystem::path& path, vtk_expander expand = nullptr);

/// The files that `read_mesh` reads: of a PVTU file its pieces too. Throws `input_error`.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path);

/// Calls `f(piece, file)` for each VTU file of a PVTU file, one in memory at a time, its points merged and in
/// the order of their global numbers. False when that is not possible, after any number of calls: for other
/// files, and for pieces without tetrahedra or without global numbers. Throws what `read_mesh` throws.
bool for_each_piece_file(const std::filesystem::path& path, vtk_expander expand,
                         const std::function<void(const loaded_mesh&, const std::filesystem::path&)>& f);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/io/read_mesh.ipp"
#endif
