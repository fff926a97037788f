/// @file
/// Mesh files that hold one mesh.
#pragma once

#include "dovetail/io/loaded_mesh.hpp"

#include <filesystem>

namespace dovetail::app {

/// Throws `command_line_error` when there is no writer for the file's extension.
void check_can_write(const std::filesystem::path& file);

/// Writes a VTU or MSH file; the extension decides. Throws `io_error` naming the file.
void write_mesh_file(const io::loaded_mesh& mesh, const std::filesystem::path& file);
/// The same for triangles.
void write_mesh_file(const simplicial_mesh<2>& mesh, const std::filesystem::path& file);

} // namespace dovetail::app
