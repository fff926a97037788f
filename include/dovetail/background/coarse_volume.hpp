/// @file
/// The coarse volume mesh inside the coarse surface mesh, of all solids, with its boundary kept; then
/// improved.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/parallel/remembering.hpp"

#include <array>
#include <functional>
#include <vector>

namespace dovetail::background {

/// How the coarse volume is made.
struct coarse_volume_options {
  /// As `meshing_options::on_failure`, for the solids that cannot be filled.
  std::function<void(piece_failure&, const simplicial_mesh<2>&)> on_failure = {};
  progress on_progress = {}; ///< told how solids come along
};

/// What is counted of a coarse volume mesh.
struct coarse_volume_counts {
  std::size_t elements = 0;    ///< how many there are
  std::size_t points = 0;      ///< how many there are
  double min_dihedral_deg = 0; ///< the smallest of all
  bool one_by_one = false;     ///< several solids were filled one after the other

  using fields = field_list<&coarse_volume_counts::elements, &coarse_volume_counts::points,
                            &coarse_volume_counts::min_dihedral_deg, &coarse_volume_counts::one_by_one>;
};

/// A coarse volume mesh.
struct coarse_volume_result {
  simplicial_mesh<3> mesh;    ///< the surface's points first, unchanged; tags are solids
  quality_statistics quality; ///< of its elements
  report summary;             ///< what was counted on the way
};

namespace detail {

/// Meshes so many pieces of this source.
using pieces_mesher = std::function<meshing_result(std::size_t count, const subdomain_source& source,
                                                   const meshing_options& options)>;

/// `coarse_volume` by such a function.
coarse_volume_result fill_solids(const surface_mesh& surface, const geometry_topology& topology,
                                 const pieces_mesher& mesh_them, const coarse_volume_options& options);

} // namespace detail

/// Fills all solids of a model with a coarse mesh that has the triangles of `surface` as sides, and improves
/// it. Solids are meshed together; if neither the mesher nor a fallback can do that, one by one. Every
/// attempt runs as a task of the executor, so with `processes` a crash of the mesher is survived. Voids need
/// no marking: what no face has as its solid stays empty. Complexity: the mesher's and the improver's.
///
/// Throws `geometry_error` when the model has no solid or a solid's surface is open, `mesher_error` naming
/// the solid that cannot be meshed.
/// \param surface that of `coarse_surface`
/// \param topology the model's: which solids are beside its faces
/// \param size edge lengths, in the model's unit
/// \param mesh_it keeps the triangles of the surface
/// \param improve improves what it makes, boundary kept
/// \param run_tasks runs each attempt as a task
/// \param options what is told of failures and of progress
template <sizing_field Size, boundary_keeping_mesher<3> Mesher, improver<3> Improver, executor Executor>
coarse_volume_result coarse_volume(const surface_mesh& surface, const geometry_topology& topology,
                                   const Size& size, const Mesher& mesh_it, const Improver& improve,
                                   const Executor& run_tasks, const coarse_volume_options& options = {}) {
  const auto mesh_them = [&](std::size_t count, const subdomain_source& source,
                             const meshing_options& attempt) {
    // Pieces of other sizes are not to be taken for these.
    return mesh_subdomains(count, source, mesh_it, improve, size, parallel::forgetful(run_tasks), attempt);
  };
  return detail::fill_solids(surface, topology, mesh_them, options);
}

/// For a model that is not decomposed: the solids behind and in front of each surface triangle, or no_id.
/// Linear but for sorting. Throws `geometry_error` as `coarse_volume`.
std::vector<std::array<local_id, 2>> solids_beside_surface(const surface_mesh& surface,
                                                           const geometry_topology& topology);

} // namespace dovetail::background

#ifndef DOVETAIL_COMPILED
#include "dovetail/background/coarse_volume.ipp"
#endif
