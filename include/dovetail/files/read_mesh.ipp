/// @file
/// What `read_mesh.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/files/merge_points.hpp"
#include "dovetail/files/mesh_parts.hpp"
#include "dovetail/files/msh_reader.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/vtu_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// What a folder without a mesh that is read has instead, in words.
inline std::string unread_files(const std::filesystem::path& folder) {
  std::error_code failure;
  std::set<std::string> formats;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const auto extension = entry.path().extension();
    if (extension == ".vtkhdf" || extension == ".h5" || extension == ".xdmf")
      formats.insert("HDF5");
    if (entry.path().stem() == "mesh" && is_number(extension.string().substr(extension.empty() ? 0 : 1)))
      formats.insert("MFEM");
  }
  if (std::filesystem::exists(folder / "processor0", failure) ||
      std::filesystem::exists(folder / "constant" / "polyMesh", failure))
    formats.insert("OpenFOAM");
  std::string text;
  for (const std::string& format : formats)
    text += (text.empty() ? "; it has files of " : ", ") + format;
  return text.empty() ? text : text + ", which have readers of their own";
}

} // namespace detail

DOVETAIL_INLINE std::vector<std::filesystem::path> mesh_files_in(const std::filesystem::path& folder) {
  std::error_code failure;
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
    if (const auto extension = entry.path().extension(); extension == ".pvtu" || extension == ".msh")
      found.push_back(entry.path());
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.extension() != ".pvtu", a) < std::tuple(b.extension() != ".pvtu", b);
  });
  return found;
}

DOVETAIL_INLINE std::filesystem::path find_mesh_file(const std::filesystem::path& path) {
  std::error_code failure;
  if (!std::filesystem::is_directory(path, failure))
    return path;
  auto found = mesh_files_in(path);
  if (found.empty())
    throw input_error(path.string() + ": there is no .pvtu or .msh file in this folder" +
                      detail::unread_files(path));
  std::erase_if(found, [first = found.front().extension()](const auto& p) { return p.extension() != first; });
  for (const char* own : {"mesh", "mesh_partitioned", "ranks"}) // of one run
    for (const auto& file : found)
      if (file.stem() == own || detail::numbered_msh_name(file).stem == own)
        return file;
  const std::string stem = detail::numbered_msh_name(found.front()).stem; // of the parts of a mesh
  for (const auto& file : found)
    if (file != found.front() && (stem.empty() || detail::numbered_msh_name(file).stem != stem))
      throw input_error(path.string() + ": there are several meshes in this folder, " +
                        found.front().filename().string() + " and " + file.filename().string() +
                        " for example; name the file that is meant");
  return found.front();
}

DOVETAIL_INLINE loaded_mesh read_mesh(const std::filesystem::path& path, vtk_expander expand, bool fields,
                                      element_order elements) {
  const auto file = find_mesh_file(path);
  const auto start = read_file(file, 256);
  if (start.find("$MeshFormat") != std::string::npos) {
    loaded_mesh read = msh_reader{elements}(file);
    return read.is_one_part() ? detail::read_all_parts(file, std::move(read), elements) : read;
  }
  if (const std::string format = detail::unread_format(start); !format.empty())
    throw input_error(file.string() + ": this is a file of " + format +
                      ", which has a reader of its own; here VTU, PVTU, VTP and MSH are read");
  if (start.find("\"UnstructuredGrid\"") != std::string::npos)
    detail::refuse_one_piece(file);
  if (start.find("<?xml") != std::string::npos || start.find("<VTKFile") != std::string::npos)
    return vtu_reader{expand, fields, elements}(file);
  throw input_error(file.string() + ": this is no mesh file that is known: neither VTU, PVTU, VTP, MSH, "
                                    "HDF5, MFEM nor OpenFOAM");
}

DOVETAIL_INLINE std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files{find_mesh_file(path)};
  const auto& file = files.front();
  const auto start = read_file(file, 256);
  if (start.find("$MeshFormat") != std::string::npos && detail::names_partitions(file)) {
    const loaded_mesh part = msh_reader{element_order::any}(file);
    return part.is_one_part() ? detail::files_of_parts(file, part) : files;
  }
  if (start.find("\"PUnstructuredGrid\"") == std::string::npos)
    return files;
  const auto content = read_file(file);
  const auto pieces = detail::pvtu_sources(file, xml_parser(content, file.string()).parse());
  files.insert(files.end(), pieces.begin(), pieces.end());
  return files;
}

DOVETAIL_INLINE std::string points_elsewhere(std::uint64_t points, global_id highest) {
  if (highest < 0 || static_cast<std::uint64_t>(highest) < points)
    return {};
  return "it has " + std::to_string(points) + " points, whose numbers go up to " + std::to_string(highest) +
         ": this is a part of a larger mesh";
}

DOVETAIL_INLINE std::string points_elsewhere(const loaded_mesh& mesh) {
  const auto& passed = mesh.passed_over;
  const bool has_subdomains = mesh.parts == 0 && (!mesh.subdomains.empty() ||
                                                  std::find(passed.begin(), passed.end(),
                                                            "the subdomains of triangles") != passed.end());
  if (!has_subdomains)
    return {};
  global_id highest = -1;
  if (const auto* numbers = mesh.scalars("mesh_node"); numbers != nullptr && !numbers->empty())
    highest = static_cast<global_id>(*std::max_element(numbers->begin(), numbers->end()));
  else if (!mesh.node_ids.empty())
    highest = *std::max_element(mesh.node_ids.begin(), mesh.node_ids.end());
  return points_elsewhere(mesh.mesh.points.size(), highest);
}

DOVETAIL_INLINE bool
for_each_piece_file(const std::filesystem::path& path, vtk_expander expand,
                    const std::function<void(const loaded_mesh&, const std::filesystem::path&)>& f,
                    element_order elements) {
  const auto file = find_mesh_file(path);
  const auto start = read_file(file, 256);
  const auto merged = [](loaded_mesh& piece, const std::filesystem::path& source) {
    try {
      merge_points(piece);
    } catch (const input_error& problem) {
      throw input_error(source.string() + ": " + problem.what());
    }
  };
  if (start.find("$MeshFormat") != std::string::npos) {
    if (!detail::names_partitions(file))
      return false;
    loaded_mesh known = msh_reader{elements}(file);
    if (!known.is_one_part() || known.mesh.elements.empty())
      return false;
    const auto files = detail::files_of_parts(file, known);
    const local_id part = known.first_part, parts = known.parts;
    for (std::size_t p = 0; p < files.size(); ++p) {
      const auto number = static_cast<local_id>(p);
      loaded_mesh piece =
          number == part ? std::exchange(known, {}) : detail::read_part(files[p], number, parts, elements);
      merged(piece, files[p]);
      f(piece, files[p]);
    }
    return true;
  }
  if (start.find("\"PUnstructuredGrid\"") == std::string::npos)
    return false;
  const auto content = read_file(file);
  for (const auto& source : detail::pvtu_sources(file, xml_parser(content, file.string()).parse())) {
    loaded_mesh piece = vtu_reader{expand, false, elements}(source);
    if (piece.mesh.elements.empty() || piece.node_ids.empty())
      return false;
    merged(piece, source);
    f(piece, source);
  }
  return true;
}

} // namespace dovetail::io
