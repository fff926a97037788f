/// @file
/// Gmsh's MSH 4.1 output of a distributed mesh, whole or partitioned.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <filesystem>
#include <string>

namespace dovetail::io {

/// Writes `<stem>.msh`. Physical groups are groups of faces, and materials. In D = 2 the nodes are all in the
/// block of the first CAD face.
struct msh_writer {
  bool binary = true;        ///< whether numbers are bytes or text
  std::string stem = "mesh"; ///< what the name of the file begins with

  /// A model of `piecewise_mesh_writer`. Memory: the skeleton with several times its size in work arrays, and
  /// one piece.
  template <int D>
  report operator()(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) const;

  /// Tasks for `finish_mesh`: a worker encodes what a piece adds to the file, and the file is put together
  /// from these parts, each of which goes as soon as it has been copied.
  template <int D>
  piecewise_output<D> begin(const distributed_simplicial_mesh<D>& mesh,
                            const std::filesystem::path& unfinished) const;
};

/// Writes `<stem>.msh` with one partitioned entity per CAD entity or interface and set of sharers; partition
/// s + 1 is subdomain s. The format has no such files of triangles alone, so D = 3.
struct partitioned_msh_writer {
  bool ghosts = false;                   ///< one layer of elements that touch another partition in a point
  bool binary = true;                    ///< whether numbers are bytes or text
  std::string stem = "mesh_partitioned"; ///< what the name of the file begins with

  /// As those of `msh_writer`.
  report operator()(const distributed_mesh& mesh, const std::filesystem::path& folder) const;
  piecewise_output<3> begin(const distributed_mesh& mesh, const std::filesystem::path& unfinished) const;
};

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/msh_writer.ipp"
#endif
