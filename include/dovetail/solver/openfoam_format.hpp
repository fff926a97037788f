/// @file
/// OpenFOAM cases: the mesh, whole or of each processor, and the dictionaries that any program asks for.
#pragma once

#include "dovetail/mesh/rank_mesh.hpp"
#include "dovetail/solver/concepts.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

/// `processor<rank>/constant/polyMesh`, or `constant/polyMesh` for one rank, as text. Patches are the groups
/// of CAD faces on the boundary of the domain, and a processor patch per neighbour; with several materials,
/// each is a cell zone. Names become words of OpenFOAM. Ghosts are left out.
///
/// In `system` are the dictionaries without which no program of OpenFOAM starts, with no more in them than it
/// takes for `checkMesh` and `reconstructParMesh`. Those of others, which lack the line that says where they
/// are from, are kept.
struct openfoam_format {
  std::string name() const { return "openfoam"; }
  std::vector<std::string> files_of_rank(local_id rank, int ranks) const;
  std::vector<std::string> files_of_rank(local_id rank) const { return files_of_rank(rank, 2); }
  std::vector<std::string> files_of_all() const;
  void write(const rank_source<3>& source, const rank_mesh<3>& rank,
             const std::vector<std::filesystem::path>& paths) const;
  void write_all(const rank_source<3>& source, const std::vector<std::filesystem::path>& paths) const;
  bool may_replace(const std::filesystem::path& file) const;
  /// What reconstructParMesh and topoSet make: numbers of cells, faces and points of the mesh there was.
  std::vector<std::string> outdated_files_of_rank(local_id rank, int ranks) const;
};
static_assert(rank_format<openfoam_format, 3>);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/openfoam_format.ipp"
#endif
