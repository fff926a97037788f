/// @file
/// Gmsh's MSH 4.1 files of a parallel solver, one per rank.
#pragma once

#include "dovetail/mesh/rank_mesh.hpp"
#include "dovetail/solver/concepts.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

/// `<stem>_1.msh`, `<stem>_2.msh`, ... with the partitioned entities of all ranks; partition q + 1 is rank q.
/// A file has all nodes of its rank; the points, lines and triangles that ranks share are elements of the
/// lowest of them. Tags are ids, counted from 1. Ghosts are elements of an entity of their own, and
/// `$GhostElements` names their owners. Elements of second order are complete ones. Each file costs n log n
/// in the skeleton.
struct rank_msh_format {
  static constexpr bool second_order = true; ///< it has nodes in the middle of edges where the mesh has
  bool binary = true;                        ///< whether numbers are bytes or text
  std::string stem = "ranks";                ///< what the names of the files begin with

  std::string name() const { return "msh-ranks"; }
  std::vector<std::string> files_of_rank(local_id rank) const {
    return {stem + "_" + std::to_string(rank + 1) + ".msh"};
  }
  std::vector<std::string> files_of_all() const { return {}; }
  void write(const rank_source<3>& source, const rank_mesh<3>& rank,
             const std::vector<std::filesystem::path>& paths) const;
  void write_all(const rank_source<3>&, const std::vector<std::filesystem::path>&) const {}
};
static_assert(rank_format<rank_msh_format, 3>);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/rank_msh_format.ipp"
#endif
