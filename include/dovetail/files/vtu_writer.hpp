/// @file
/// VTK output of a distributed mesh: one PVTU with a VTU per piece, and the boundary and the interfaces as
/// VTP files.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <filesystem>
#include <string>

namespace dovetail::io {

/// Writes `<stem>.pvtu` and its parts `<stem>_0000.vtu`, ..., `surface.vtp` (the boundary of the domain) and
/// `interfaces.vtp` (faces between subdomains, where there are several);
/// in D = 2 `lines.vtp` instead, the edges of CAD curves and of lines between subdomains. See docs/formats.md
/// for the arrays.
struct vtu_writer {
  int files = 0;             ///< number of VTU files; 0: one per subdomain, never more than subdomains
  std::string stem = "mesh"; ///< what the name of the file begins with

  /// A model of `piecewise_mesh_writer`. Memory: the skeleton, twice its size in work arrays, and one loaded
  /// subdomain.
  template <int D>
  report operator()(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) const;

  /// The files as tasks for `finish_mesh`: a VTU file takes the pieces of its subdomains.
  template <int D>
  piecewise_output<D> begin(const distributed_simplicial_mesh<D>& mesh,
                            const std::filesystem::path& unfinished) const;
};

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/vtu_writer.ipp"
#endif
