/// @file
/// MFEM's parallel meshes, a file per rank.
#pragma once

#include "dovetail/mesh/rank_mesh.hpp"
#include "dovetail/solver/concepts.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

/// `<stem>.000000`, `<stem>.000001`, ..., text of version 1.2: what `mfem::ParMesh(comm, stream)` reads, with
/// a process per file. Attributes of elements are materials, those of boundary elements groups of CAD faces,
/// both counted from 1 and named in comments; sides between materials are boundary elements too, in the file
/// of the lowest rank. Of second order the nodes are a grid function of H1_3D_P2. Ghosts are left out: MFEM
/// makes its own.
struct mfem_format {
  static constexpr bool second_order = true; ///< it has nodes in the middle of edges where the mesh has
  std::string stem = "mesh";                 ///< what the names of the files begin with

  std::string name() const { return "mfem"; }
  std::vector<std::string> files_of_rank(local_id rank) const;
  std::vector<std::string> files_of_all() const { return {}; }
  void write(const rank_source<3>& source, const rank_mesh<3>& rank,
             const std::vector<std::filesystem::path>& paths) const;
  void write_all(const rank_source<3>&, const std::vector<std::filesystem::path>&) const {}
};
static_assert(rank_format<mfem_format, 3>);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/mfem_format.ipp"
#endif
