/// @file
/// Decomposed OpenFOAM cases: the mesh of each processor.
#pragma once

#include "dovetail/mesh/rank_mesh.hpp"
#include "dovetail/solver/concepts.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

/// `processor<rank>/constant/polyMesh`, as text. Patches are the groups of CAD faces on the boundary of the
/// domain, and a processor patch per neighbour; with several materials, each is a cell zone. Names become
/// words of OpenFOAM. Ghosts are left out.
struct openfoam_format {
  std::string name() const { return "openfoam"; }
  std::vector<std::string> files_of_rank(local_id rank) const;
  std::vector<std::string> files_of_all() const { return {}; }
  void write(const rank_source<3>& source, const rank_mesh<3>& rank,
             const std::vector<std::filesystem::path>& paths) const;
  void write_all(const rank_source<3>&, const std::vector<std::filesystem::path>&) const {}
};
static_assert(rank_format<openfoam_format, 3>);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/openfoam_format.ipp"
#endif
