/// @file
/// What `realize.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/decomposition/skeleton_part.hpp"
#include "dovetail/pipeline/dimension_steps.hpp"
#include "dovetail/pipeline/realize.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"
#include "dovetail/skeleton/remesh_lines.hpp"
#include "dovetail/skeleton/segment_matching.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace dovetail {

namespace detail {

/// Remeshes the lines of a skeleton; those that were remeshed already and have not changed stay.
template <int D, bound_parameters<D> Parameters>
void space_lines(const any_geometry& model, const surface_mesh& surface, std::span<const vec3> coarse_points,
                 const refined_sizing& size, skeleton_memo& made, const Parameters& given,
                 realized<D>& result) {
  remeshed_lines before{std::move(result.lines.lines), std::move(result.lines.names)};
  auto remeshed = remesh_lines(model, result.coarse.lines, coarse_points, size, given.run_tasks, made.lines,
                               given.options.on_progress, std::move(before));
  result.lines = number_lines(result.coarse, std::move(remeshed), coarse_points, surface.vertex_hosts,
                              std::move(result.lines));
}

/// The surface step of both dimensions: the skeleton of the pieces of a surface, and of the interface faces
/// that end on it.
inline coarse_skeleton skeleton_between(const simplicial_background<2>& mesh, const divided_background<2>&,
                                        const std::vector<local_id>& subdomain_of_element) {
  return extract_skeleton(mesh.surface, own_subdomains(subdomain_of_element), {}, mesh_state::valid);
}
inline coarse_skeleton skeleton_between(const simplicial_background<3>& mesh,
                                        const divided_background<3>& divided,
                                        const std::vector<local_id>& subdomain_of_element) {
  return extract_skeleton(mesh.surface, induced_subdomains(divided.beside_surface, subdomain_of_element),
                          interface_faces(mesh, divided.sides, subdomain_of_element, mesh_state::valid),
                          mesh_state::valid);
}

/// A skeleton with its lines remeshed.
template <int D, bound_parameters<D> Parameters>
realized<D> realize_lines(const any_geometry& model, const simplicial_background<D>& mesh,
                          coarse_skeleton coarse, const refined_sizing& size, skeleton_memo& made,
                          const Parameters& given) {
  const stopwatch clock;
  const std::size_t made_before = made.lines.made();
  realized<D> result;
  result.coarse = std::move(coarse);
  space_lines(model, mesh.surface, mesh.points(), size, made, given, result);
  result.summary.name = "skeleton";
  result.counts.lines = result.coarse.lines.size();
  result.counts.regions = result.coarse.regions.size();
  result.counts.lines_made = made.lines.made() - made_before;
  result.counts.line_seconds = clock.seconds();
  return result;
}

template <bound_parameters<2> Parameters>
realized<2> realize_boundaries(const any_geometry& model, const simplicial_background<2>& mesh,
                               const divided_background<2>& divided, coarse_skeleton coarse,
                               const std::vector<local_id>& subdomain_of_element, std::span<const local_id>,
                               const refined_sizing& size, skeleton_memo& made, const Parameters& given) {
  auto result = realize_lines<2>(model, mesh, std::move(coarse), size, made, given);
  result.fine = skeleton_of_lines(mesh.surface, divided.sides, subdomain_of_element, result.lines);
  result.counts.edges = result.fine.sides.size();
  result.counts.points = result.fine.points.size();
  return result;
}

/// The patches of a skeleton, where wanted on lines with numbers of segments that suit each other. Better
/// small angles than patches that fail: their lines are as they were then.
template <bound_parameters<3> Parameters>
skeleton_patches patches_on_matched_lines(const skeleton_to_remesh<any_geometry>& of, realized<3>& result,
                                          skeleton_memo& made, const Parameters& given) {
  const progress& on_progress = given.options.on_progress;
  const auto fill = [&] {
    return mesh_patches(of, given.mesh_surface, given.run_tasks, made.patches, on_progress);
  };
  const auto fill_again = [&] {
    space_lines<3>(of.model, of.surface, of.coarse_points, of.size, made, given, result);
    return fill();
  };
  auto patches = fill();
  const stopwatch clock;
  const double wanted = wanted_angles_of<3>(given.simplify_by).face_deg;
  std::size_t matched = 0;
  if (given.options.match_segments && patches.failures.empty())
    matched =
        match_segments(of.model, of.coarse_points, result.coarse, {result.lines.lines, result.lines.names},
                       faces_with_small_angles(patches, result.coarse, made.patches, wanted), of.size, wanted,
                       given.mesh_surface, given.run_tasks, made.segments, on_progress);
  result.counts.matching_seconds = clock.seconds();
  if (matched > 0)
    patches = fill_again();
  while (matched > 0 && !patches.failures.empty()) {
    const std::size_t unmatched = unmatch_segments(patches.failures, of.surface, result.coarse);
    if (unmatched == 0)
      break;
    matched -= unmatched;
    patches = fill_again();
  }
  result.counts.matched_lines = matched;
  return patches;
}

template <bound_parameters<3> Parameters>
realized<3> realize_boundaries(const any_geometry& model, const simplicial_background<3>& mesh,
                               const divided_background<3>&, coarse_skeleton coarse,
                               const std::vector<local_id>&, std::span<const local_id> material_of_subdomain,
                               const refined_sizing& size, skeleton_memo& made, const Parameters& given) {
  const std::size_t lines_before = made.lines.made(), patches_before = made.patches.meshes.made();
  auto result = realize_lines<3>(model, mesh, std::move(coarse), size, made, given);
  const skeleton_to_remesh of{model,        mesh.surface, mesh.points(),        result.coarse,
                              result.lines, size,         material_of_subdomain};
  auto remeshed = join_patches(of, patches_on_matched_lines(of, result, made, given), given.run_tasks,
                               made.patches, given.options.on_progress);
  result.fine = std::move(remeshed.fine);
  result.patches = std::move(remeshed.patches);
  result.lines = {};
  result.counts.interface_faces = remeshed.counts.interface_faces;
  result.counts.triangles = remeshed.counts.triangles;
  result.counts.points = remeshed.counts.points;
  append(result.summary.warnings, remeshed.summary.warnings);
  append(result.summary.children, remeshed.summary.children);
  result.counts.lines_made = made.lines.made() - lines_before;
  result.counts.patches_made = made.patches.meshes.made() - patches_before;
  return result;
}

/// With this skeleton, or a part of it.
template <int D, bound_parameters<D> Parameters>
realized<D> realize_skeleton(const any_geometry& model, const simplicial_background<D>& mesh,
                             const divided_background<D>& divided, coarse_skeleton coarse,
                             std::vector<local_id> subdomain_of_element, std::size_t subdomains,
                             const refined_sizing& size, skeleton_memo& made, const Parameters& given) {
  const auto materials = materials_of(mesh);
  std::vector<local_id> material_of_subdomain(subdomains, 0);
  for (std::size_t e = 0; e < subdomain_of_element.size(); ++e)
    if (D == 3) // elements of what is not divided are solids, and have no tags
      material_of_subdomain[subdomain_of_element[e]] =
          materials.empty() ? static_cast<local_id>(e) : materials[e];
  auto result = realize_boundaries(model, mesh, divided, std::move(coarse), subdomain_of_element,
                                   material_of_subdomain, size, made, given);
  result.material_of_subdomain = std::move(material_of_subdomain);
  result.subdomain_of_element = std::move(subdomain_of_element);
  result.summary.set(result.counts);
  return result;
}

} // namespace detail

template <int D, bound_parameters<D> Parameters>
realized<D> realize(const any_geometry& model, const simplicial_background<D>& mesh,
                    const divided_background<D>& divided, std::vector<local_id> subdomain_of_element,
                    std::size_t subdomains, const refined_sizing& size, skeleton_memo& made,
                    const Parameters& given) {
  const stopwatch clock;
  auto coarse = detail::skeleton_between(mesh, divided, subdomain_of_element);
  auto result = detail::realize_skeleton<D>(model, mesh, divided, std::move(coarse),
                                            std::move(subdomain_of_element), subdomains, size, made, given);
  result.summary.seconds = clock.seconds();
  return result;
}

template <bound_parameters<3> Parameters>
realized<3> realize_part(const any_geometry& model, const simplicial_background<3>& mesh,
                         const divided_background<3>& divided, std::vector<local_id> subdomain_of_element,
                         std::size_t subdomains, const refined_sizing& size, skeleton_memo& made,
                         const Parameters& given, const std::vector<bool>& is_wanted) {
  const stopwatch clock;
  auto coarse =
      part_at_points(detail::skeleton_between(mesh, divided, subdomain_of_element), mesh.surface, is_wanted);
  auto result = detail::realize_skeleton<3>(model, mesh, divided, std::move(coarse),
                                            std::move(subdomain_of_element), subdomains, size, made, given);
  result.is_part = true;
  result.summary.seconds = clock.seconds();
  return result;
}

namespace detail {

/// The names of the patches that bound some subdomains.
inline std::vector<kept<patch_mesh>> patches_around(const realized<3>& made,
                                                    std::span<const local_id> subdomains) {
  const auto is_one = [&](local_id s) { return std::binary_search(subdomains.begin(), subdomains.end(), s); };
  std::vector<kept<patch_mesh>> patches;
  std::size_t patch = 0;
  const auto look_at = [&](const auto& region_or_face) {
    const auto& [behind, in_front] = region_or_face.subdomains;
    if (is_one(behind) || is_one(in_front))
      patches.push_back(made.patches.of_patch[patch]);
    ++patch;
  };
  std::for_each(made.coarse.regions.begin(), made.coarse.regions.end(), look_at);
  std::for_each(made.coarse.faces.begin(), made.coarse.faces.end(), look_at);
  return patches;
}

} // namespace detail

template <bound_parameters<3> Parameters>
realized<3> realize_around(const any_geometry& model, const simplicial_background<3>& mesh,
                           const divided_background<3>& divided, std::vector<local_id> subdomain_of_element,
                           std::size_t subdomains, const refined_sizing& size, skeleton_memo& made,
                           const Parameters& given) {
  if (mesh.volume.elements.empty()) // not divided: what there is are the solids
    return realize<3>(model, mesh, divided, std::move(subdomain_of_element), subdomains, size, made, given);
  const stopwatch clock;
  const std::size_t lines_before = made.lines.made(), patches_before = made.patches.meshes.made();
  const coarse_skeleton whole = detail::skeleton_between(mesh, divided, subdomain_of_element);
  auto around = points_with_surroundings(mesh.volume, subdomain_of_element, given.options.only);
  std::vector<kept<patch_mesh>> bounds;
  const auto is_settled = [&](const realized<3>& result) {
    if (!result.is_part || !result.patches.failures.empty())
      return true;
    const auto before = std::exchange(bounds, detail::patches_around(result, given.options.only));
    return bounds == before;
  };
  realized<3> result;
  double line_seconds = 0, matching_seconds = 0;
  do {
    result = detail::realize_skeleton<3>(model, mesh, divided, part_at_points(whole, mesh.surface, around),
                                         subdomain_of_element, subdomains, size, made, given);
    line_seconds += result.counts.line_seconds;
    matching_seconds += result.counts.matching_seconds;
    auto farther = points_around<3>(mesh.volume.elements, around);
    result.is_part = farther != around;
    around = std::move(farther);
  } while (!is_settled(result));
  result.counts.line_seconds = line_seconds;
  result.counts.matching_seconds = matching_seconds;
  result.counts.lines_made = made.lines.made() - lines_before;
  result.counts.patches_made = made.patches.meshes.made() - patches_before;
  result.summary.set(result.counts);
  result.summary.seconds = clock.seconds();
  return result;
}

#ifdef DOVETAIL_COMPILED
template realized<2> realize<2>(const any_geometry& model, const simplicial_background<2>& mesh,
                                const divided_background<2>& divided,
                                std::vector<local_id> subdomain_of_element, std::size_t subdomains,
                                const refined_sizing& size, skeleton_memo& made,
                                const any_parameters<2>& given);
template realized<3> realize<3>(const any_geometry& model, const simplicial_background<3>& mesh,
                                const divided_background<3>& divided,
                                std::vector<local_id> subdomain_of_element, std::size_t subdomains,
                                const refined_sizing& size, skeleton_memo& made,
                                const any_parameters<3>& given);
template realized<3> realize_part(const any_geometry& model, const simplicial_background<3>& mesh,
                                  const divided_background<3>& divided,
                                  std::vector<local_id> subdomain_of_element, std::size_t subdomains,
                                  const refined_sizing& size, skeleton_memo& made,
                                  const any_parameters<3>& given, const std::vector<bool>& is_wanted);
template realized<3> realize_around(const any_geometry& model, const simplicial_background<3>& mesh,
                                    const divided_background<3>& divided,
                                    std::vector<local_id> subdomain_of_element, std::size_t subdomains,
                                    const refined_sizing& size, skeleton_memo& made,
                                    const any_parameters<3>& given);
#endif

} // namespace dovetail
