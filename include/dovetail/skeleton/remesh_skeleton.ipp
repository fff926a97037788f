/// @file
/// What `remesh_skeleton.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/surface_deviation.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"
#include "dovetail/skeleton/skeleton_assembly.hpp"

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>

namespace dovetail {

namespace detail {

/// The patches of a skeleton, and what is wrong with one.
class skeleton_parts {
public:
  explicit skeleton_parts(const skeleton_to_remesh& of)
      : model_(of.model), surface_(of.surface), coarse_points_(of.coarse_points), skeleton_(of.skeleton),
        lines_(of.lines) {}

  bool is_reversed(std::size_t p) const {
    return is_region(p) ? model_.topology().faces[skeleton_.regions[p].cad_face].reversed
                        : !same_turn(key_order(face_of(p)), face_of(p).vertices);
  }

  region_set patches() {
    region_set set;
    set.count = skeleton_.regions.size() + skeleton_.faces.size();
    set.build = [this](const any_geometry& own, std::size_t p) { return region(own, p); };
    set.surface_of = [this](const any_geometry& own, std::size_t p) {
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
    for (const skeleton_face& face : skeleton_.faces)
      lines_of_face_.push_back(lines_of(face, lines_.keys));
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
  skeleton_patch patch(const any_geometry& own, std::size_t p) const {
    return is_region(p) ? region_patch(own, surface_, skeleton_.regions[p], lines_)
                        : interface_patch(face_of(p), coarse_points_, lines_).patch;
  }

  surface_region region(const any_geometry& own, std::size_t p) const {
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

  const any_geometry& model_;
  const surface_mesh& surface_;
  std::span<const vec3> coarse_points_;
  const coarse_skeleton& skeleton_;
  const numbered_lines& lines_;
  std::vector<std::array<local_id, 3>> lines_of_face_;
};

DOVETAIL_INLINE skeleton_patches
mesh_patches_by(const skeleton_to_remesh& of,
                const std::function<meshed_regions(region_set&, const mesh_regions_options&)>& mesh_them,
                region_memo& made, const progress& on_progress) {
  const std::size_t made_before = made.meshes.made();
  skeleton_parts parts(of);
  region_set set = parts.patches();
  skeleton_patches result;
  result.meshes = mesh_them(set, {.parameters = false,
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

} // namespace detail

DOVETAIL_INLINE std::vector<local_id> faces_with_small_angles(const skeleton_patches& patches,
                                                              const coarse_skeleton& skeleton,
                                                              const region_memo& made, double threshold_deg) {
  std::vector<local_id> faces;
  for (std::size_t f = 0; f < skeleton.faces.size(); ++f)
    if (made.known.at(patches.meshes.of_region[skeleton.regions.size() + f]).least_angle_deg < threshold_deg)
      faces.push_back(static_cast<local_id>(f));
  return faces;
}

DOVETAIL_INLINE remeshed_skeleton
detail::join_patches_by(const skeleton_to_remesh& of, skeleton_patches patches, const region_memo& made,
                        const std::function<fine_skeleton(const skeleton_assembly&)>& assemble) {
  const detail::skeleton_parts parts(of);
  const detail::patches_to_join joined{of.skeleton,
                                       of.lines,
                                       patches.meshes,
                                       made,
                                       [&](std::size_t p) { return parts.is_reversed(p); },
                                       of.material_of_subdomain};
  const detail::skeleton_assembly assembly(joined);
  remeshed_skeleton result;
  result.fine = assemble(assembly);
  result.patches.line_points = static_cast<local_id>(of.lines.points.size());
  for (const std::size_t first : assembly.first_triangles())
    result.patches.first_triangle.push_back(static_cast<local_id>(first));
  report deviation;
  for (std::size_t p = 0; p < of.skeleton.regions.size(); ++p)
    note_deviation(deviation, "face " + std::to_string(of.skeleton.regions[p].cad_face),
                   made.known.at(patches.meshes.of_region[p]).deviation);
  result.patches.of_patch = std::move(patches.meshes.of_region);
  result.patches.failures = std::move(patches.failures);
  warn_of_deviations(result.summary, deviation);
  result.summary.children.push_back(std::move(deviation));
  result.counts = {.interface_faces = of.skeleton.faces.size(),
                   .triangles = result.fine.sides.size(),
                   .points = result.fine.points.size(),
                   .patches_made = patches.made};
  result.summary.set(result.counts);
  return result;
}

} // namespace dovetail
