/// @file
/// Mesh files that hold one mesh.
#pragma once

#include "dovetail/files/write_msh.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace dovetail::app {

/// Whether a mesh read from a file is one of triangles: it has no tetrahedra.
bool is_of_triangles(const io::loaded_mesh& mesh);
/// Its triangles as a mesh of their own, with their tags.
simplicial_mesh<2> take_triangles(io::loaded_mesh mesh);

/// Warns where a mesh read from this file is a part of another one.
void warn_of_part(const io::loaded_mesh& mesh, const std::filesystem::path& file);
/// In words; empty where it is not. The points of a surface are always some of a mesh.
std::string part_of_larger(const io::loaded_mesh& mesh, const std::filesystem::path& file);

/// Of a mesh whose pieces come one after the other: whether they are part of a larger one.
class numbers_of_pieces {
public:
  /// One more piece, its points in the order of their global numbers.
  void add(const io::loaded_mesh& piece);
  /// In words; empty: they are not.
  std::string elsewhere(std::uint64_t points) const;

private:
  bool by_dovetail_ = false; ///< has numbered them
  global_id highest_ = -1;
};

/// The extension of a file in lower case, with its dot.
std::string extension_of(const std::filesystem::path& file);

/// Throws `command_line_error` when there is no writer for the file's extension.
void check_can_write(const std::filesystem::path& file);

/// Whether a file of this name is written as VTU, which has room for fields.
bool is_vtu(const std::filesystem::path& file);

/// Writes a VTU or MSH file; the extension decides. Fields are for VTU alone. Throws `io_error` naming the
/// file.
void write_mesh_file(const io::loaded_mesh& mesh, const std::filesystem::path& file);

} // namespace dovetail::app
