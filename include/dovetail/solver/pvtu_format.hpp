/// @file
/// VTK files of a parallel solver: a VTU per rank, and a PVTU that names them.
#pragma once

#include "dovetail/mesh/rank_mesh.hpp"
#include "dovetail/solver/concepts.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

/// "0007": a rank in the name of a file.
std::string rank_digits(local_id rank);

/// `<stem>.pvtu` and `<stem>_0000.vtu`, one per rank. What another rank owns has vtkGhostType 1; global ids
/// are contiguous per rank. Elements of second order are those of VTK. See docs/formats.md for the arrays.
struct pvtu_format {
  static constexpr bool second_order = true; ///< it has nodes in the middle of edges where the mesh has
  std::string stem = "ranks";                ///< what the names of the files begin with

  std::string name() const { return "pvtu"; }
  std::vector<std::string> files_of_rank(local_id rank) const {
    return {stem + "_" + rank_digits(rank) + ".vtu"};
  }
  std::vector<std::string> files_of_all() const { return {stem + ".pvtu"}; }
  template <int D>
  void write(const rank_source<D>& source, const rank_mesh<D>& mesh,
             const std::vector<std::filesystem::path>& paths) const;
  template <int D>
  void write_all(const rank_source<D>& source, const std::vector<std::filesystem::path>& paths) const;
};
static_assert(rank_format<pvtu_format, 2> && rank_format<pvtu_format, 3>);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/pvtu_format.ipp"
#endif
