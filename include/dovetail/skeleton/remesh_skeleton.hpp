/// @file
/// Remeshes the patches of a skeleton whose lines are remeshed: regions and interface faces, each once,
/// through the executor (paper, section 3.5); then puts all together.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/sizing/size_balls.hpp"
#include "dovetail/skeleton/fine_lines.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "dovetail/skeleton/skeleton_assembly.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <set>
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
template <geometry_model Geometry>
struct skeleton_to_remesh {
  const Geometry& model;                           ///< what the surface is of
  const surface_mesh& surface;                     ///< the coarse surface
  std::span<const vec3> coarse_points;             ///< of the coarse mesh
  const coarse_skeleton& skeleton;                 ///< its lines, regions and interface faces
  const numbered_lines& lines;                     ///< its lines, remeshed
  const refined_sizing& size;                      ///< edge lengths wanted
  std::span<const local_id> material_of_subdomain; ///< by subdomain
};
template <geometry_model Geometry>
skeleton_to_remesh(const Geometry&, const surface_mesh&, std::span<const vec3>, const coarse_skeleton&,
                   const numbered_lines&, const refined_sizing&, std::span<const local_id>)
    -> skeleton_to_remesh<Geometry>;

/// The patches of a skeleton before they are put together; they lie where they were made.
struct skeleton_patches {
  meshed_regions meshes;               ///< regions first, then interface faces
  std::vector<patch_failure> failures; ///< those that could not be remeshed
  std::size_t made = 0;                ///< the others were made before
};

namespace detail {

/// The patches of a skeleton, and what is wrong with one.
template <geometry_model Geometry>
class skeleton_parts {
public:
  explicit skeleton_parts(const skeleton_to_remesh<Geometry>& of)
      : model_(of.model), surface_(of.surface), coarse_points_(of.coarse_points), skeleton_(of.skeleton),
        lines_(of.lines) {}

  bool is_reversed(std::size_t p) const {
    return is_region(p) ? model_.topology().faces[skeleton_.regions[p].cad_face].reversed
                        : !same_turn(key_order(face_of(p)), face_of(p).vertices);
  }

  region_set<Geometry> patches() {
    region_set<Geometry> set;
    set.count = skeleton_.regions.size() + skeleton_.faces.size();
    set.build = [this](const Geometry& own, std::size_t p) { return region(own, p); };
    set.surface_of = [this](const Geometry& own, std::size_t p) {
      return is_region(p) ? surface_of_face(own, skeleton_.regions[p].cad_face)
                          : any_surface::holding(interface_patch(face_of(p), coarse_points_, lines_).surface);
    };
    set.surface_points = [this](std::size_t p) {
      std::vector<vec3> corners;
      if (!is_region(p))
        for (const local_id v : key_order(face_of(p)))
          corners.push_back(coarse_points_[v]);
      return corners;
    };
    if (lines_.names.empty())
      return set;
    lines_of_face_ = lines_of_faces(skeleton_);
    set.boundary_points = boundary_points();
    set.outline_of = [this](std::size_t p) {
      return interface_outline(face_of(p), lines_of_face_[p - skeleton_.regions.size()], lines_);
    };
    set.boundary_name = [this](std::size_t p) -> std::optional<kept<patch_boundary>> {
      if (is_region(p))
        return std::nullopt;
      const auto& [a, b, c] = lines_of_face_[p - skeleton_.regions.size()];
      return kept<patch_boundary>::of(lines_.names[a], lines_.names[b], lines_.names[c]);
    };
    return set;
  }

  std::string name_of(std::size_t p) const {
    if (!is_region(p))
      return "interface face " + std::to_string(p - skeleton_.regions.size());
    const local_id f = skeleton_.regions[p].cad_face;
    return "a region of " + entity_name("face", f, model_.topology().faces[f].name);
  }

  patch_failure failure_of(std::size_t p, const patch_mesh& mesh) const {
    patch_failure failure;
    (is_region(p) ? failure.region : failure.face) =
        static_cast<local_id>(is_region(p) ? p : p - skeleton_.regions.size());
    const skeleton_patch made = patch(model_, p);
    const patch_boundary& boundary = made.boundary;
    std::set<local_id> segments(mesh.misplaced.begin(), mesh.misplaced.end()), lines;
    for (const auto& pair : mesh.crossings)
      segments.insert(pair.begin(), pair.end());
    for (const local_id s : segments) {
      const auto [a, b] = boundary.segments[s];
      const vec3 from = boundary.points[a], to = boundary.points[b];
      failure.edges.push_back({midpoint(from, to), 0, distance(from, to)});
      lines.insert(made.line_of_segment[s]);
    }
    for (const local_id line : lines)
      if (line != no_id && lines_.keys[line].on.dimension > 1)
        failure.removable_lines.push_back(line);
    if (mesh.folded.empty()) {
      failure.reason =
          name_of(p) + ": its boundary lines cross in the parameter plane; give a smaller size there";
      return failure;
    }
    failure.reason = name_of(p) + ": " + folds_of(mesh);
    const std::vector<vec3>& frozen = boundary.points;
    for (const local_id t : mesh.folded) {
      std::array<vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t v = mesh.triangles[t][k];
        corners[k] = v < frozen.size() ? frozen[v] : mesh.inner_points[v - frozen.size()];
      }
      failure.folded.push_back(corners);
    }
    return failure;
  }

private:
  /// Of all patches together, about: a line on the surface bounds two regions, and it may bound faces.
  std::size_t boundary_points() const {
    std::size_t sum = 0;
    for (std::size_t l = 0; l < lines_.keys.size(); ++l)
      if (lines_.keys[l].on.dimension < 3)
        sum += 2 * (lines_.lines[l].points.size() + 1);
    for (const auto& its : lines_of_face_)
      for (const local_id line : its)
        sum += lines_.lines[line].points.size() + 1;
    return sum;
  }

  skeleton_patch patch(const Geometry& own, std::size_t p) const {
    return is_region(p) ? region_patch(own, surface_, skeleton_.regions[p], lines_)
                        : interface_patch(face_of(p), coarse_points_, lines_).patch;
  }

  surface_region region(const Geometry& own, std::size_t p) const {
    surface_region built;
    built.boundary = patch(own, p).boundary;
    if (is_region(p))
      built.face = skeleton_.regions[p].cad_face;
    built.reversed = is_reversed(p);
    return built;
  }

  bool is_region(std::size_t patch) const { return patch < skeleton_.regions.size(); }
  const skeleton_face& face_of(std::size_t patch) const {
    return skeleton_.faces[patch - skeleton_.regions.size()];
  }

  const Geometry& model_;
  const surface_mesh& surface_;
  std::span<const vec3> coarse_points_;
  const coarse_skeleton& skeleton_;
  const numbered_lines& lines_;
  std::vector<std::array<local_id, 3>> lines_of_face_;
};

} // namespace detail

/// Remeshes what lies between remeshed lines to the sizing field. `made` carries patches from one call to the
/// next as long as the model, the plain field and the mesher are the same. About linear in the triangles
/// made. Faults come back as `failures`; throws `mesher_error` when a patch cannot be evaluated at all.
/// \param of the coarse skeleton with its remeshed lines
/// \param mesher meshes regions and interface faces between lines
/// \param run carries out independent tasks; the result does not depend on it
/// \param made patches of earlier rounds; grows
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <geometry_model Geometry, surface_mesher Mesher, executor Executor>
skeleton_patches mesh_patches(const skeleton_to_remesh<Geometry>& of, const Mesher& mesher,
                              const Executor& run, region_memo& made, const progress& on_progress = {}) {
  const std::size_t made_before = made.meshes.made();
  detail::skeleton_parts parts(of);
  region_set<Geometry> set = parts.patches();
  skeleton_patches result;
  result.meshes = mesh_regions(of.model, set, mesher, of.size, run, made,
                               {.parameters = false,
                                .deviation = true,
                                .angles = true,
                                .on_progress = on_progress,
                                .stage = "skeleton"});
  if (!result.meshes.failures.empty()) {
    const auto& [patch, reason] = *result.meshes.failures.begin();
    throw mesher_error("remeshing of " + parts.name_of(patch) + " failed: " + reason);
  }
  result.meshes.for_each(
      made, [&](std::size_t p) { return made.known.at(result.meshes.of_region[p]).is_faulty; },
      [&](std::size_t p, const patch_mesh& mesh) { result.failures.push_back(parts.failure_of(p, mesh)); });
  result.made = made.meshes.made() - made_before;
  return result;
}

/// The interface faces with an angle below a threshold, growing.
std::vector<local_id> faces_with_small_angles(const skeleton_patches& patches,
                                              const coarse_skeleton& skeleton, const region_memo& made,
                                              double threshold_deg);

namespace detail {

/// A skeleton that was put together, with what is reported of it.
remeshed_skeleton with_counts(const patches_to_join& of, const skeleton_assembly& assembly,
                              fine_skeleton fine, skeleton_patches&& patches);

} // namespace detail

/// Puts patches together. The result is on all ranks, in memory that they share where they can.
/// Linear.
/// Throws nothing but for a lack of memory.
/// \param of the coarse skeleton with its remeshed lines
/// \param patches from `mesh_patches`
/// \param run tells all ranks
/// \param made what `mesh_patches` has made
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <geometry_model Geometry, executor Executor>
remeshed_skeleton join_patches(const skeleton_to_remesh<Geometry>& of, skeleton_patches patches,
                               const Executor& run, const region_memo& made,
                               const progress& on_progress = {}) {
  const detail::skeleton_parts parts(of);
  const detail::patches_to_join to_join{of.skeleton,
                                        of.lines,
                                        patches.meshes,
                                        made,
                                        [&](std::size_t p) { return parts.is_reversed(p); },
                                        of.material_of_subdomain};
  const detail::skeleton_assembly assembly(to_join);
  fine_skeleton fine = assembly.run(run, on_progress);
  return detail::with_counts(to_join, assembly, std::move(fine), std::move(patches));
}

/// `mesh_patches` and `join_patches`.
/// About linear in the triangles made. Patches that fail are in the result; throws `mesher_error` when one
/// cannot be evaluated at all.
/// \param of the coarse skeleton with its remeshed lines
/// \param mesher meshes regions and interface faces between lines
/// \param run carries out independent tasks; the result does not depend on it
/// \param made patches of earlier rounds; grows
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <geometry_model Geometry, surface_mesher Mesher, executor Executor>
remeshed_skeleton remesh_skeleton(const skeleton_to_remesh<Geometry>& of, const Mesher& mesher,
                                  const Executor& run, region_memo& made, const progress& on_progress = {}) {
  return join_patches(of, mesh_patches(of, mesher, run, made, on_progress), run, made, on_progress);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/remesh_skeleton.ipp"
#endif
