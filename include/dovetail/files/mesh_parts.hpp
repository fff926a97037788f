/// @file
/// Meshes in several files: which files belong together, and which files are a part of something.
#pragma once

#include "dovetail/mesh/loaded_mesh.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io::detail {

inline bool is_number(const std::string& text) {
  return !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
}

/// "<stem>_<number>.msh" taken apart; no stem for other names.
struct numbered_msh_name {
  std::string stem{};
  std::string digits{};

  explicit numbered_msh_name(const std::filesystem::path& file);
  /// That of another number, with as many digits where they begin with 0.
  std::string with(local_id number) const;
};

/// The files of all parts of a mesh, told from that of one: parts are counted from 1 in their names. Throws
/// `input_error` when the name does not say so.
std::vector<std::filesystem::path> files_of_parts(const std::filesystem::path& file, const loaded_mesh& part);

/// Reads one of these files. Throws `input_error` when it is a part of something else.
loaded_mesh read_part(const std::filesystem::path& file, local_id part, local_id parts,
                      element_order elements);

/// The mesh of which a file has one part.
loaded_mesh read_all_parts(const std::filesystem::path& file, loaded_mesh part, element_order elements);

/// Whether an MSH file has, before its nodes, a section about partitions.
bool names_partitions(const std::filesystem::path& file);

/// Throws `input_error` for a VTU file that a PVTU file beside it names as one of several.
void refuse_one_piece(const std::filesystem::path& file);

/// A format that is written and checked and not read, told by how a file begins; empty: none of these.
std::string unread_format(const std::string& start);

} // namespace dovetail::io::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/mesh_parts.ipp"
#endif
