/// @file
/// A surface of triangles from any file that has one, as it is: nothing is repaired.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

struct surface_file {
  simplicial_mesh<2> surface;                               ///< tags: groups, none negative
  std::vector<std::pair<local_id, std::string>> names = {}; ///< of groups
  std::vector<std::string> warnings = {};
};

/// Reads the triangles of an STL, OBJ, OFF, PLY, VTU, PVTU, VTP or MSH file. Points at one place become one,
/// as most of these formats have a point for each triangle that uses it; points without triangles are left
/// out, and so are triangles of which two corners became one. Throws `input_error` naming the file.
surface_file read_surface_file(const std::filesystem::path& file);

} // namespace dovetail::app
