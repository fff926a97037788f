/// @file
/// Meshes of every format that is written.
#pragma once

#include "dovetail/files/piece_visitor.hpp"
#include "dovetail/files/second_order_nodes.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <filesystem>
#include <vector>

namespace dovetail::app {

/// The meshes in a folder, each by one of its files: a PVTU, MSH, XDMF or VTKHDF file, MFEM's of the first
/// rank; the folder itself for a case of OpenFOAM.
std::vector<std::filesystem::path> all_meshes_in(const std::filesystem::path& folder);

/// What is to be judged where this is given: of a folder that is no mesh itself, the one in it. Throws
/// `input_error`.
std::filesystem::path find_any_mesh(const std::filesystem::path& path);

/// As `io::files_of_mesh`, of any format.
std::vector<std::filesystem::path> files_of_any_mesh(const std::filesystem::path& path);

/// As `io::for_each_piece_file`, of any format.
bool for_each_piece_of_any(const std::filesystem::path& path, const io::piece_visitor& f,
                           io::element_order elements = io::element_order::first);

/// As `io::read_mesh`, of any format.
io::loaded_mesh read_any_mesh(const std::filesystem::path& path,
                              io::element_order elements = io::element_order::first, bool fields = false);

/// Calls `f` with the mesh of the corners.
template <class F>
void with_corners(const io::loaded_mesh& mesh, const F& f) {
  if (io::detail::has_middles(mesh))
    f(io::corners_of(mesh));
  else
    f(mesh);
}

} // namespace dovetail::app
