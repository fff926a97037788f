/// @file
/// What `mesh_parts.hpp` declares.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/xml_tree.hpp"
#include "dovetail/files/merge_points.hpp"
#include "dovetail/files/mesh_parts.hpp"
#include "dovetail/files/msh_reader.hpp"
#include "dovetail/files/vtu_reader.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace dovetail::io {

namespace detail {

DOVETAIL_INLINE numbered_msh_name::numbered_msh_name(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  const auto at = name.rfind('_');
  if (file.extension() == ".msh" && at != std::string::npos && is_number(name.substr(at + 1))) {
    stem = name.substr(0, at);
    digits = name.substr(at + 1);
  }
}

DOVETAIL_INLINE std::string numbered_msh_name::with(local_id number) const {
  std::string other = std::to_string(number);
  if (digits.starts_with('0') && other.size() < digits.size())
    other.insert(0, digits.size() - other.size(), '0');
  return stem + "_" + other + ".msh";
}

DOVETAIL_INLINE std::vector<std::filesystem::path> files_of_parts(const std::filesystem::path& file,
                                                                  const loaded_mesh& part) {
  const numbered_msh_name name(file);
  const std::string which = "part " + std::to_string(part.first_part + 1) + " of a mesh in " +
                            std::to_string(part.parts) + " parts";
  if (name.stem.empty() || std::stoll(name.digits) != part.first_part + 1)
    throw input_error(file.string() + ": this is " + which +
                      "; the others are not found, since it is not called NAME_" +
                      std::to_string(part.first_part + 1) + ".msh as files of parts are");
  std::vector<std::filesystem::path> files;
  for (local_id p = 1; p <= part.parts; ++p)
    files.push_back(file.parent_path() / name.with(p));
  std::error_code failure;
  for (const auto& each : files)
    if (!std::filesystem::exists(each, failure))
      throw input_error(each.string() + ": there is no such file, and " + file.filename().string() + " is " +
                        which);
  return files;
}

DOVETAIL_INLINE loaded_mesh read_part(const std::filesystem::path& file, local_id part, local_id parts,
                                      element_order elements) {
  loaded_mesh read = msh_reader{elements}(file);
  if (read.parts != parts || read.parts_here != 1 || read.first_part != part)
    throw input_error(file.string() + ": this is not part " + std::to_string(part + 1) + " of a mesh in " +
                      std::to_string(parts) + " parts, as the files beside it say");
  return read;
}

DOVETAIL_INLINE loaded_mesh read_all_parts(const std::filesystem::path& file, loaded_mesh part,
                                           element_order elements) {
  const auto files = files_of_parts(file, part);
  loaded_mesh whole;
  for (std::size_t p = 0; p < files.size(); ++p) {
    const auto number = static_cast<local_id>(p);
    append_part(whole, number == part.first_part ? part : read_part(files[p], number, part.parts, elements));
  }
  complete_point_data(whole);
  try {
    merge_points(whole);
  } catch (const input_error& problem) {
    throw input_error(file.string() + ": " + problem.what());
  }
  whole.files = files;
  return whole;
}

DOVETAIL_INLINE bool names_partitions(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string partitions = "$PartitionedEntities", nodes = "$Nodes";
  std::string seen;
  for (std::string next(std::size_t{1} << 16, '\0'); stream;) {
    stream.read(next.data(), static_cast<std::streamsize>(next.size()));
    const auto from = seen.size() < partitions.size() ? 0 : seen.size() - partitions.size();
    seen.append(next, 0, static_cast<std::size_t>(stream.gcount()));
    if (seen.find(partitions, from) != std::string::npos)
      return true;
    if (seen.find(nodes, from) != std::string::npos)
      return false;
  }
  return false;
}

DOVETAIL_INLINE void refuse_one_piece(const std::filesystem::path& file) {
  std::error_code failure;
  const auto folder = file.parent_path().empty() ? std::filesystem::path(".") : file.parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    if (entry.path().extension() != ".pvtu")
      continue;
    const std::filesystem::path whole = file.parent_path() / entry.path().filename();
    std::vector<std::filesystem::path> pieces;
    try {
      const auto content = read_file(whole);
      pieces = pvtu_sources(whole, xml_parser(content, whole.string()).parse());
    } catch (const input_error&) { // of that file nothing is wanted
    }
    const bool found = std::any_of(pieces.begin(), pieces.end(), [&](const std::filesystem::path& piece) {
      return piece.lexically_normal() == file.lexically_normal();
    });
    if (found && pieces.size() > 1)
      throw input_error(file.string() + ": this is one of the " + std::to_string(pieces.size()) +
                        " files of " + whole.string() + ", not a whole mesh; give that one");
  }
}

DOVETAIL_INLINE std::string unread_format(const std::string& start) {
  if (start.starts_with("\x89HDF"))
    return "HDF5";
  if (start.find("<Xdmf") != std::string::npos)
    return "XDMF";
  if (start.starts_with("MFEM mesh") || start.starts_with("MFEM INLINE"))
    return "MFEM";
  return start.find("FoamFile") != std::string::npos ? "OpenFOAM" : "";
}

} // namespace detail

} // namespace dovetail::io
