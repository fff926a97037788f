#include "mesh_files.hpp"

#include "failure.hpp"

#include "dovetail/files/read_mesh.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <utility>

namespace dovetail::app {

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_of_triangles(const io::loaded_mesh& mesh) {
  return mesh.mesh.elements.empty() && !mesh.triangles.empty();
}

simplicial_mesh<2> take_triangles(io::loaded_mesh mesh) {
  return {std::move(mesh.mesh.points), std::move(mesh.triangles), std::move(mesh.triangle_tags)};
}

std::string part_of_larger(const io::loaded_mesh& mesh, const std::filesystem::path& file) {
  return extension_of(file) == ".vtp" ? std::string() : io::points_elsewhere(mesh);
}

void numbers_of_pieces::add(const io::loaded_mesh& piece) {
  by_dovetail_ = by_dovetail_ || (piece.parts == 0 && !piece.subdomains.empty());
  highest_ = std::max(highest_, piece.node_ids.back());
}

std::string numbers_of_pieces::elsewhere(std::uint64_t points) const {
  return by_dovetail_ ? io::points_elsewhere(points, highest_) : std::string();
}

void warn_of_part(const io::loaded_mesh& mesh, const std::filesystem::path& file) {
  if (const std::string part = part_of_larger(mesh, file); !part.empty())
    std::fprintf(stderr, "warning: %s: %s\n", file.c_str(), part.c_str());
}

void check_can_write(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  if (extension != ".vtu" && extension != ".msh")
    throw command_line_error(file.string() + ": meshes are written to files with the extension .vtu or .msh");
}

bool is_vtu(const std::filesystem::path& file) {
  return extension_of(file) == ".vtu";
}

void write_mesh_file(const io::loaded_mesh& mesh, const std::filesystem::path& file) {
  if (extension_of(file) == ".msh")
    io::write_msh(mesh, file);
  else
    io::write_vtu(mesh, file);
}

} // namespace dovetail::app
