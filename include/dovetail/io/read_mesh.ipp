/// @file
/// What `read_mesh.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/io/msh_reader.hpp"
#include "dovetail/io/read_mesh.hpp"
#include "dovetail/io/vtu_reader.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

DOVETAIL_INLINE std::filesystem::path find_mesh_file(const std::filesystem::path& path) {
  std::error_code failure;
  if (!std::filesystem::is_directory(path, failure))
    return path;
  std::filesystem::path found;
  for (const auto& entry : std::filesystem::directory_iterator(path, failure))
    if (const auto extension = entry.path().extension(); extension == ".pvtu" || extension == ".msh")
      if (found.empty() || (extension == ".pvtu" && found.extension() != ".pvtu") ||
          (extension == found.extension() && entry.path() < found))
        found = entry.path();
  if (found.empty())
    throw input_error(path.string() + ": there is no .pvtu or .msh file in this folder");
  return found;
}

DOVETAIL_INLINE loaded_mesh read_mesh(const std::filesystem::path& path, vtk_expander expand) {
  const auto file = find_mesh_file(path);
  const auto start = read_file(file, 256);
  if (start.find("$MeshFormat") != std::string::npos)
    return msh_reader{}(file);
  if (start.find("<?xml") != std::string::npos || start.find("<VTKFile") != std::string::npos)
    return vtu_reader{expand}(file);
  throw input_error(file.string() + ": this is no mesh file that is known: neither VTU, PVTU, VTP nor MSH");
}

DOVETAIL_INLINE std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files{find_mesh_file(path)};
  const auto& file = files.front();
  if (read_file(file, 256).find("\"PUnstructuredGrid\"") == std::string::npos)
    return files;
  const auto content = read_file(file);
  const auto pieces = detail::pvtu_sources(file, xml_parser(content, file.string()).parse());
  files.insert(files.end(), pieces.begin(), pieces.end());
  return files;
}

DOVETAIL_INLINE bool
for_each_piece_file(const std::filesystem::path& path, vtk_expander expand,
                    const std::function<void(const loaded_mesh&, const std::filesystem::path&)>& f) {
  const auto file = find_mesh_file(path);
  if (read_file(file, 256).find("\"PUnstructuredGrid\"") == std::string::npos)
    return false;
  const auto content = read_file(file);
  for (const auto& source : detail::pvtu_sources(file, xml_parser(content, file.string()).parse())) {
    loaded_mesh piece = vtu_reader{expand}(source);
    if (piece.mesh.elements.empty() || piece.node_ids.empty())
      return false;
    try {
      merge_points(piece);
    } catch (const input_error& problem) {
      throw input_error(source.string() + ": " + problem.what());
    }
    f(piece, source);
  }
  return true;
}

} // namespace dovetail::io
