/// @file
/// What crosses in a realized decomposition, and what to do about it: in D = 3 patches of the skeleton,
/// before pieces are meshed; in D = 2 finished pieces, since what lies between their lines is meshed with
/// them.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/pipeline/intersection_counts.hpp"
#include "dovetail/pipeline/realize.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Whether all faces are known to lie in one plane. Pieces there cannot cross: each covers what its lines
/// enclose, which is checked, and the lines were tested with the background mesh.
bool lies_in_one_plane(const any_geometry& model);

/// All pieces as one mesh; the elements' tags are CAD faces.
simplicial_mesh<2> joined_pieces(const simplicial_skeleton<2>& skeleton, const meshed_pieces<2>& meshed);

/// A region that is folded over is refined there. An interface face that fails is merged away. Where lines
/// cross in a region's parameter plane they are refined first; then the interfaces that end on those of them
/// that are on no CAD curve are merged away.
suppression_plan plan_for_failed_patches(const coarse_skeleton& coarse,
                                         const std::vector<patch_failure>& failures);

} // namespace detail

/// What to do about the boundaries of pieces, before these are meshed: in D = 2 nothing. Counts in
/// `counts` and `seconds`. After a merge most patches are of a skeleton that was searched before.
template <bound_parameters<3> Parameters>
suppression_plan plan_for_boundaries(const realized<3>& made, skeleton_memo& known, const Parameters& given,
                                     intersection_counts& counts, double& seconds) {
  const remeshed_patches& patches = made.patches;
  if (!patches.failures.empty())
    return detail::plan_for_failed_patches(made.coarse, patches.failures);
  const stopwatch clock;
  given.options.on_progress("intersection", 0, 0);
  std::vector<bool> planar(made.fine.sides.size(), false);
  for (std::size_t f = 0; f < made.coarse.faces.size(); ++f)
    if (!made.coarse.faces[f].is_curved) {
      const std::size_t patch = made.coarse.regions.size() + f;
      std::fill(planar.begin() + patches.first_triangle[patch],
                planar.begin() + patches.first_triangle[patch + 1], true);
    }
  auto plan = plan_suppression(
      made.fine, planar, given.run_tasks,
      known_from_patches(made.fine, patches.first_triangle, patches.of_patch, known.patches_apart), {},
      given.options.on_progress);
  if (plan.empty() && !made.is_part) {
    known.patches_apart = patches.of_patch;
    sort_unique(known.patches_apart);
  }
  counts.crossings += plan.crossings;
  ++counts.rounds;
  seconds += clock.seconds();
  return plan;
}
template <bound_parameters<2> Parameters>
suppression_plan plan_for_boundaries(const realized<2>&, skeleton_memo&, const Parameters&,
                                     intersection_counts&, double&) {
  return {};
}

/// Where pieces fail since regions of theirs are folded over or the lines around them cross: there smaller
/// sizes may help. The regions of the failed pieces are meshed again by the surface mesher.
template <bound_parameters<2> Parameters>
std::vector<surface_crossing>
faults_of_failed_pieces(const any_geometry& model, const simplicial_background<2>& mesh,
                        const realized<2>& made, const std::vector<piece_failure>& failures,
                        const refined_sizing& size, skeleton_memo& known, const Parameters& given) try {
  std::set<local_id> failed;
  for (const piece_failure& failure : failures)
    failed.insert(failure.subdomain);
  coarse_skeleton of_failed = made.coarse;
  std::erase_if(of_failed.regions, [&](const auto& region) {
    return !failed.contains(region.subdomains[0]) && !failed.contains(region.subdomains[1]);
  });
  const skeleton_to_remesh of{model,      mesh.surface, mesh.surface.mesh.points,  of_failed,
                              made.lines, size,         made.material_of_subdomain};
  const auto again = mesh_patches(of, given.mesh_surface, given.run_tasks, known.patches);
  suppression_plan plan = detail::plan_for_failed_patches(of_failed, again.failures);
  append(plan.surface_crossings, plan.interface_crossings);
  return std::move(plan.surface_crossings);
} catch (const mesher_error&) {
  return {}; // the failures tell more
}
/// Tetrahedra fail inside boundaries that were found whole.
template <bound_parameters<3> Parameters>
std::vector<surface_crossing> faults_of_failed_pieces(const any_geometry&, const simplicial_background<3>&,
                                                      const realized<3>&, const std::vector<piece_failure>&,
                                                      const refined_sizing&, skeleton_memo&,
                                                      const Parameters&) {
  return {};
}

/// What to do about finished pieces, in an order that does not depend on the executor. Loads points and
/// triangles of all pieces at once, also from a disk: about 32 bytes per triangle with the search's lists,
/// which is the only step of D = 2 that needs memory for the whole mesh. Nothing is loaded when the model
/// lies in one plane. O(n log n); on smooth surfaces a small part of the time for meshing them.
template <bound_parameters<2> Parameters>
suppression_plan plan_for_pieces(const any_geometry& model, const realized<2>& made,
                                 const meshed_pieces<2>& meshed, const Parameters& given,
                                 intersection_counts& counts, double& seconds) {
  suppression_plan plan;
  if (!meshed.failures.empty() || detail::lies_in_one_plane(model))
    return plan;
  const stopwatch clock;
  const simplicial_mesh<2> whole = detail::joined_pieces(made.fine, meshed);
  for (const auto& [i, j] :
       crossing_triangles(whole.points, whole.elements, {}, given.run_tasks, {}, given.options.on_progress))
    plan.surface_crossings.push_back(detail::describe_crossing(
        whole.points, whole.elements, whole.tags, static_cast<std::size_t>(i), static_cast<std::size_t>(j)));
  plan.crossings = plan.surface_crossings.size();
  counts.crossings += plan.crossings;
  seconds += clock.seconds();
  return plan;
}
/// Tetrahedra inside a boundary without crossings do not cross.
template <bound_parameters<3> Parameters>
suppression_plan plan_for_pieces(const any_geometry&, const realized<3>&, const meshed_pieces<3>&,
                                 const Parameters&, intersection_counts&, double&) {
  return {};
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/crossings.ipp"
#endif
