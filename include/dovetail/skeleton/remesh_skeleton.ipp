/// @file
/// What `remesh_skeleton.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/surface_deviation.hpp"
#include "dovetail/skeleton/patches.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"
#include "dovetail/skeleton/skeleton_assembly.hpp"

#include <set>

namespace dovetail {

namespace detail {

class skeleton_remesher {
public:
  skeleton_remesher(const any_geometry& model, const surface_mesh& surface,
                    std::span<const vec3> coarse_points, const coarse_skeleton& skeleton,
                    const numbered_lines& lines, const refined_sizing& size, const any_surface_mesher& mesher,
                    std::span<const local_id> material_of_subdomain, const any_executor& run,
                    region_store& made, const progress& on_progress)
      : model_(model), surface_(surface), coarse_points_(coarse_points), skeleton_(skeleton), lines_(lines),
        size_(size), mesher_(mesher), material_of_subdomain_(material_of_subdomain), run_(run), store_(made),
        on_progress_(on_progress) {}

  remeshed_skeleton run() {
    const std::size_t made_before = store_.meshes.made();
    mesh_patches();
    remeshed_skeleton result = assemble();
    result.summary.set("interface_faces", static_cast<double>(skeleton_.faces.size()));
    result.summary.set("triangles", static_cast<double>(result.fine.sides.size()));
    result.summary.set("points", static_cast<double>(result.fine.points.size()));
    result.summary.set("patches_made", static_cast<double>(store_.meshes.made() - made_before));
    return result;
  }

private:
  static std::size_t at(local_id i) { return static_cast<std::size_t>(i); }
  bool is_region(std::size_t patch) const { return patch < skeleton_.regions.size(); }
  const skeleton_face& face_of(std::size_t patch) const {
    return skeleton_.faces[patch - skeleton_.regions.size()];
  }

  skeleton_patch patch(std::size_t p) const {
    return is_region(p) ? region_patch(model_, surface_, skeleton_.regions[p], lines_)
                        : interface_patch(face_of(p), coarse_points_, lines_).patch;
  }

  surface_region region(std::size_t p) const {
    surface_region built;
    built.boundary = patch(p).boundary;
    if (is_region(p))
      built.face = skeleton_.regions[p].cad_face;
    built.reversed = is_reversed(p);
    return built;
  }

  bool is_reversed(std::size_t p) const {
    return is_region(p) ? model_.topology().faces[at(skeleton_.regions[p].cad_face)].reversed
                        : !same_turn(key_order(face_of(p)), face_of(p).vertices);
  }

  region_set patches() const {
    region_set set;
    set.count = skeleton_.regions.size() + skeleton_.faces.size();
    set.build = [this](std::size_t p) { return region(p); };
    set.surface_of = [this](const any_geometry& own, std::size_t p) {
      return is_region(p) ? surface_of_face(own, skeleton_.regions[p].cad_face)
                          : any_surface::holding(interface_patch(face_of(p), coarse_points_, lines_).surface);
    };
    set.surface_keys.resize(skeleton_.regions.size());
    for (const skeleton_face& face : skeleton_.faces) {
      std::vector<vec3> corners;
      for (const local_id v : key_order(face))
        corners.push_back(coarse_points_[at(v)]);
      set.surface_keys.push_back(key_maker{}(corners).key());
    }
    return set;
  }

  void mesh_patches() {
    region_set set = patches();
    meshed_ = mesh_regions(
        model_, set, mesher_, size_, run_, store_,
        {.parameters = false, .deviation = true, .on_progress = on_progress_, .stage = "skeleton"});
    if (!meshed_.failures.empty()) {
      const auto& [patch, reason] = *meshed_.failures.begin();
      throw mesher_error("remeshing of " + name_of(patch) + " failed: " + reason);
    }
  }

  std::string name_of(std::size_t p) const {
    if (!is_region(p))
      return "interface face " + std::to_string(p - skeleton_.regions.size());
    const local_id f = skeleton_.regions[p].cad_face;
    const std::string& name = model_.topology().faces[at(f)].name;
    return "a region of face " + std::to_string(f) + (name.empty() ? "" : " (" + name + ")");
  }

  remeshed_skeleton assemble() {
    const patches_to_join patches{skeleton_,
                                  lines_,
                                  meshed_,
                                  store_,
                                  [this](std::size_t p) { return is_reversed(p); },
                                  material_of_subdomain_};
    const skeleton_assembly assembly(patches);
    remeshed_skeleton result;
    result.fine = assembly.run(run_, on_progress_);
    result.patches.line_points = static_cast<local_id>(lines_.points.size());
    for (const std::size_t first : assembly.first_triangles())
      result.patches.first_triangle.push_back(static_cast<local_id>(first));
    report deviation;
    for (std::size_t p = 0; p < skeleton_.regions.size(); ++p)
      note_deviation(deviation, "face " + std::to_string(skeleton_.regions[p].cad_face), known(p).deviation);
    meshed_.for_each(
        store_, [&](std::size_t p) { return known(p).is_faulty; },
        [&](std::size_t p, const patch_mesh& mesh) {
          result.patches.failures.push_back(failure_of(p, mesh));
        });
    result.patches.keys = std::move(meshed_.keys);
    warn_of_deviations(result.summary, deviation);
    result.summary.children.push_back(std::move(deviation));
    return result;
  }

  const region_store::known_mesh& known(std::size_t p) const { return store_.known.at(meshed_.keys[p]); }

  patch_failure failure_of(std::size_t p, const patch_mesh& mesh) const {
    patch_failure failure;
    (is_region(p) ? failure.region : failure.face) =
        static_cast<local_id>(is_region(p) ? p : p - skeleton_.regions.size());
    const skeleton_patch made = patch(p);
    const patch_boundary& boundary = made.boundary;
    std::set<local_id> segments(mesh.misplaced.begin(), mesh.misplaced.end()), lines;
    for (const auto& pair : mesh.crossings)
      segments.insert(pair.begin(), pair.end());
    for (const local_id s : segments) {
      const auto [a, b] = boundary.segments[at(s)];
      const vec3 from = boundary.points[at(a)], to = boundary.points[at(b)];
      failure.edges.push_back({midpoint(from, to), 0, distance(from, to)});
      lines.insert(made.line_of_segment[at(s)]);
    }
    for (const local_id line : lines)
      if (line != no_id && lines_.keys[at(line)].on.dimension > 1)
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
        const std::size_t v = at(mesh.triangles[at(t)][k]);
        corners[k] = v < frozen.size() ? frozen[v] : mesh.inner_points[v - frozen.size()];
      }
      failure.folded.push_back(corners);
    }
    return failure;
  }

  const any_geometry& model_;
  const surface_mesh& surface_;
  std::span<const vec3> coarse_points_;
  const coarse_skeleton& skeleton_;
  const numbered_lines& lines_;
  const refined_sizing& size_;
  const any_surface_mesher& mesher_;
  std::span<const local_id> material_of_subdomain_;
  const any_executor& run_;
  region_store& store_;
  const progress& on_progress_;
  meshed_regions meshed_;
};

} // namespace detail

DOVETAIL_INLINE remeshed_skeleton
remesh_skeleton(const any_geometry& model, const surface_mesh& surface, std::span<const vec3> coarse_points,
                const coarse_skeleton& skeleton, const numbered_lines& lines, const refined_sizing& size,
                const any_surface_mesher& mesher, std::span<const local_id> material_of_subdomain,
                const any_executor& run, region_store& made, const progress& on_progress) {
  return detail::skeleton_remesher(model, surface, coarse_points, skeleton, lines, size, mesher,
                                   material_of_subdomain, run, made, on_progress)
      .run();
}

} // namespace dovetail
