/// @file
/// Gmsh's MSH 4.1 output of a distributed mesh, whole or partitioned.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/io/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <filesystem>
#include <string>

namespace dovetail::io {

/// Writes `<stem>.msh`. Physical groups are boundary patches and materials. A partitioned file (D = 3) has
/// one partitioned entity per CAD entity or interface and set of sharers; partition s + 1 is subdomain s. In
/// D = 2 the nodes are all in the block of the first CAD face.
struct msh_writer {
  bool partitioned = false;
  bool ghosts = false; ///< with `partitioned`: one layer of elements that touch another partition in a point
  bool binary = true;
  std::string stem = "mesh";

  /// A model of `piecewise_mesh_writer`. Memory: the skeleton with several times its size in work arrays, and
  /// one piece. Throws `usage_error` when a mesh of D = 2 is to be partitioned.
  template <int D>
  report operator()(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) const;

  /// Tasks for `finish_mesh`: a worker encodes what a piece adds to the file, and the file is put together
  /// from these parts, each of which goes as soon as it has been copied.
  template <int D>
  piecewise_output<D> begin(const distributed_simplicial_mesh<D>& mesh,
                            const std::filesystem::path& unfinished) const;
};

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/io/msh_writer.ipp"
#endif
