/// @file
/// Remeshes the patches of a skeleton whose lines are remeshed: regions and interface faces, each once,
/// through the executor (paper, section 3.5); then puts all together.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/sizing/size_balls.hpp"
#include "dovetail/skeleton/fine_lines.hpp"
#include "dovetail/skeleton/skeleton_assembly.hpp"

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// A region or face that could not be remeshed, and lines on CAD faces at the fault that a merge would
/// remove; or one that stays folded over.
struct patch_failure {
  local_id region = no_id;                      ///< or no_id
  local_id face = no_id;                        ///< or no_id
  std::vector<local_id> removable_lines;        ///< lines at the fault that do not lie on CAD curves
  std::vector<std::array<vec3, 3>> folded = {}; ///< triangles that turn away from the surface
  std::vector<size_ball> edges = {};            ///< at the fault: their middles and lengths
  std::string reason;                           ///< what the mesher said
};

/// The patches of a fine skeleton; the regions come first and the interface faces behind them.
struct remeshed_patches {
  std::vector<local_id> first_triangle;   ///< of each patch, in the skeleton; and the end
  local_id line_points = 0;               ///< of the skeleton: the first ones
  std::vector<kept<patch_mesh>> of_patch; ///< the names of their meshes
  std::vector<patch_failure> failures;    ///< the skeleton is incomplete when there are any
};

/// What is counted of the patches of a skeleton.
struct patch_counts {
  std::size_t interface_faces = 0; ///< coarse ones
  std::size_t triangles = 0;       ///< of the fine skeleton
  std::size_t points = 0;          ///< of the fine skeleton
  std::size_t patches_made = 0;    ///< the others were made before

  using fields = field_list<&patch_counts::interface_faces, &patch_counts::triangles, &patch_counts::points,
                            &patch_counts::patches_made>;
};

/// A skeleton whose patches are remeshed.
struct remeshed_skeleton {
  fine_skeleton fine;       ///< all patches together
  remeshed_patches patches; ///< patch by patch
  patch_counts counts;      ///< what was counted on the way
  report summary;           ///< the same, with warnings and deviations
};

/// What is remeshed: a skeleton of a coarse surface and what lies inside it, with its lines. All of it
/// outlives the calls that it is given to.
struct skeleton_to_remesh {
  const any_geometry& model;                       ///< what the surface is of
  const surface_mesh& surface;                     ///< the coarse surface
  std::span<const vec3> coarse_points;             ///< of the coarse mesh
  const coarse_skeleton& skeleton;                 ///< its lines, regions and interface faces
  const numbered_lines& lines;                     ///< its lines, remeshed
  const refined_sizing& size;                      ///< edge lengths wanted
  std::span<const local_id> material_of_subdomain; ///< by subdomain
};

/// The patches of a skeleton before they are put together; they lie where they were made.
struct skeleton_patches {
  meshed_regions meshes;               ///< regions first, then interface faces
  std::vector<patch_failure> failures; ///< those that could not be remeshed
  std::size_t made = 0;                ///< the others were made before
};

namespace detail {

/// `mesh_patches` by a function that meshes all patches as regions.
skeleton_patches
mesh_patches_by(const skeleton_to_remesh& of,
                const std::function<meshed_regions(region_set&, const mesh_regions_options&)>& mesh_them,
                region_memo& made, const progress& on_progress);

} // namespace detail

/// Remeshes what lies between remeshed lines to the sizing field. `made` carries patches from one call to the
/// next as long as the model, the plain field and the mesher are the same. About linear in the triangles
/// made. Faults come back as `failures`; throws `mesher_error` when a patch cannot be evaluated at all.
/// \param of the coarse skeleton with its remeshed lines
/// \param mesher meshes regions and interface faces between lines
/// \param run carries out independent tasks; the result does not depend on it
/// \param made patches of earlier rounds; grows
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <surface_mesher Mesher, executor Executor>
skeleton_patches mesh_patches(const skeleton_to_remesh& of, const Mesher& mesher, const Executor& run,
                              region_memo& made, const progress& on_progress = {}) {
  const auto mesh_them = [&](region_set& set, const mesh_regions_options& options) {
    return mesh_regions(of.model, set, mesher, of.size, run, made, options);
  };
  return detail::mesh_patches_by(of, mesh_them, made, on_progress);
}

/// The interface faces with an angle below a threshold, growing.
std::vector<local_id> faces_with_small_angles(const skeleton_patches& patches,
                                              const coarse_skeleton& skeleton, const region_memo& made,
                                              double threshold_deg);

namespace detail {

/// Joins patches by a function that carries the tasks out.
remeshed_skeleton join_patches_by(const skeleton_to_remesh& of, skeleton_patches patches,
                                  const region_memo& made,
                                  const std::function<fine_skeleton(const skeleton_assembly&)>& assemble);

} // namespace detail

/// Puts patches together. The result is on all ranks, in memory that they share where they can.
/// Linear.
/// Throws nothing but for a lack of memory.
/// \param of the coarse skeleton with its remeshed lines
/// \param patches from `mesh_patches`
/// \param run tells all ranks
/// \param made what `mesh_patches` has made
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <executor Executor>
remeshed_skeleton join_patches(const skeleton_to_remesh& of, skeleton_patches patches, const Executor& run,
                               const region_memo& made, const progress& on_progress = {}) {
  return detail::join_patches_by(
      of, std::move(patches), made,
      [&](const detail::skeleton_assembly& assembly) { return assembly.run(run, on_progress); });
}

/// `mesh_patches` and `join_patches`.
/// About linear in the triangles made. Patches that fail are in the result; throws `mesher_error` when one
/// cannot be evaluated at all.
/// \param of the coarse skeleton with its remeshed lines
/// \param mesher meshes regions and interface faces between lines
/// \param run carries out independent tasks; the result does not depend on it
/// \param made patches of earlier rounds; grows
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <surface_mesher Mesher, executor Executor>
remeshed_skeleton remesh_skeleton(const skeleton_to_remesh& of, const Mesher& mesher, const Executor& run,
                                  region_memo& made, const progress& on_progress = {}) {
  return join_patches(of, mesh_patches(of, mesher, run, made, on_progress), run, made, on_progress);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/remesh_skeleton.ipp"
#endif
