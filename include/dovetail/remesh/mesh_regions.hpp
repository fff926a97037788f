/// @file
/// The step from regions with frozen boundaries to their meshes: of the faces of a coarse surface, of the
/// regions and interface faces of a skeleton, and of the regions of a piece of D = 2.
///
/// Whoever the surface mesher is, what fails is tried in the same order: again without the edges that another
/// region has as well (chords), again with smaller sizes inside where triangles are folded over; what is left
/// of such edges is split, and the result is checked. What is wrong after that is handed back as data.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/policy.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/parallel/memo.hpp"
#include "dovetail/remesh/concepts.hpp"
#include "dovetail/remesh/surface_deviation.hpp"
#include "dovetail/remesh/surface_region.hpp"
#include "dovetail/sizing/refined_sizing.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dovetail {

/// How often a region is tried before its faults are handed back.
struct region_attempts {
  int chords = 6; ///< times again without inner edges that must not be
  int folds = 6;  ///< times again with sizes inside 0.8 times those before, while triangles are folded over
};

namespace detail {

/// Throws `mesher_error` that begins with `who` unless the triangles of a result name points that exist, and
/// points are where their parameters are, up to what another way of rounding does.
void check_points_of(const patch_mesh& made, const any_surface& surface, const patch_boundary& boundary,
                     const std::string& who);
/// Throws `mesher_error` that begins with `who` when a mesh does not end at its region's boundary.
void check_region(const patch_mesh& made, const patch_boundary& boundary, const std::string& who);
/// Adds the chords of a mesh that its region must not have to the forbidden edges; false when it has no new
/// ones.
bool forbid_own_chords(const surface_region& region, const patch_mesh& made, patch_boundary& boundary);
/// Splits what is left of inner edges that must not be.
void split_unwanted_chords(const any_surface& surface, const patch_boundary& boundary, patch_mesh& made);

/// A mesher's result, of which everything else may then look up what it names.
template <surface_mesher Mesher>
patch_mesh mesh_once(const Mesher& mesher, const any_surface& surface, const patch_boundary& boundary,
                     const any_sizing& size) {
  const auto who = [&] { return named_policy("surface mesher", policy_name(mesher)); };
  patch_mesh made = call_policy<mesher_error>(who, [&] { return mesher(surface, boundary, size); });
  check_points_of(made, surface, boundary, who());
  return made;
}

/// One attempt at a region: without the edges that it must not have.
template <surface_mesher Mesher>
patch_mesh mesh_without_chords(const Mesher& mesher, const any_surface& surface, const surface_region& region,
                               const any_sizing& size, int rounds) {
  patch_boundary boundary = region.boundary;
  patch_mesh made = mesh_once(mesher, surface, boundary, size);
  for (int round = 0; round < rounds && forbid_own_chords(region, made, boundary); ++round)
    made = mesh_once(mesher, surface, boundary, size);
  split_unwanted_chords(surface, boundary, made);
  return made;
}

} // namespace detail

/// Meshes one region on its surface, and again as long as `attempts` allow; of attempts with folds the one
/// with the fewest. Inner edges that must not be are split where the mesher did not avoid them: those that
/// are forbidden, and those that join two boundary points a second time. Costs what the mesher does. Throws
/// `mesher_error` when a segment of the boundary is not a side of exactly one triangle or a side inside not
/// one of two, and what the mesher throws.
template <surface_mesher Mesher>
patch_mesh mesh_region(const Mesher& mesher, const any_surface& surface, const surface_region& region,
                       const any_sizing& size, const region_attempts& attempts) {
  patch_mesh best;
  double factor = region.size_factor;
  for (int attempt = 0; attempt == 0 || (attempt <= attempts.folds && !best.folded.empty()); ++attempt) {
    const any_sizing inner = [&size, factor](vec3 p) { return factor * size(p); };
    patch_mesh made =
        detail::mesh_without_chords(mesher, surface, region, factor == 1 ? size : inner, attempts.chords);
    if (attempt == 0 || made.folded.size() < best.folded.size())
      best = std::move(made);
    factor *= 0.8;
  }
  detail::check_region(best, region.boundary, named_policy("surface mesher", policy_name(mesher)));
  return best;
}

/// In words, of a mesh that is folded over still.
inline std::string folded_triangles(const patch_mesh& made) {
  const std::size_t count = made.folded.size();
  return count == 1 ? "a triangle stays folded over" : std::to_string(count) + " triangles stay folded over";
}

/// What is wrong with a region that is folded over still.
inline std::string folds_of(const patch_mesh& made) {
  return folded_triangles(made) + "; repair the face or give a smaller size there";
}

/// Regions that share boundary points, by the same labels. Their boundaries together are as large as their
/// meshes, so each is built when it is needed and not held.
template <geometry_model Geometry>
struct region_set {
  std::size_t count = 0;           ///< how many regions there are
  std::size_t boundary_points = 0; ///< of all of them together, about, where that is known
  /// A region without `surface` and `forbids`, from a model of the worker's own; pure.
  std::function<surface_region(const Geometry&, std::size_t)> build;
  /// The surface of a region, from a model of the worker's own.
  std::function<any_surface(const Geometry&, std::size_t)> surface_of;
  /// For regions on no face: the points that their surface, and with it the parameters of their boundary, is
  /// a function of beside the boundary's points; none for regions on a face. Empty where all are.
  std::function<std::vector<vec3>(std::size_t)> surface_points = {};
  /// The boundary of a region on no face, which may lack its parameters; where there is none, `build` tells.
  std::function<patch_boundary(std::size_t)> outline_of = {};
  /// For regions on no face, whose labels are all different: a name of what the points of their boundary,
  /// their order and the segments are a function of, beside the surface's points. Outlines may lack points
  /// then.
  std::function<std::optional<kept<patch_boundary>>(std::size_t)> boundary_name = {};
  /// Edges that a region must not have since another one has them; `mesh_regions` adds to them.
  std::map<std::size_t, std::vector<simplex<1>>> forbidden_edges = {};

  /// The points that tell a region's surface and parameters; none where these are not known.
  std::vector<vec3> points_of_surface(std::size_t r) const {
    return surface_points ? surface_points(r) : std::vector<vec3>{};
  }
  /// The name of its boundary; none where that is not known.
  std::optional<kept<patch_boundary>> name_of_boundary(std::size_t r) const {
    return boundary_name ? boundary_name(r) : std::nullopt;
  }
  /// A region with its boundary and the edges it must not have.
  surface_region region(const Geometry& own, std::size_t r) const {
    return with_forbidden_edges(r, build(own, r));
  }
  /// The same, perhaps without its parameters, and its points where the boundary has a name.
  surface_region outline(const Geometry& own, std::size_t r) const {
    if (!outline_of || points_of_surface(r).empty())
      return region(own, r);
    surface_region built;
    built.boundary = outline_of(r);
    return with_forbidden_edges(r, std::move(built));
  }

private:
  surface_region with_forbidden_edges(std::size_t r, surface_region built) const {
    if (const auto more = forbidden_edges.find(r); more != forbidden_edges.end())
      append(built.boundary.forbidden_edges, more->second);
    return built;
  }
};

/// Meshes of regions, each made once, and what is asked of them so often that it is not read from them again.
struct region_memo {
  /// A mesh that was made, in numbers.
  struct known_mesh {
    std::size_t inner_points = 0, triangles = 0; ///< points inside its boundary, and all triangles
    bool is_faulty = false;              ///< folded over, or no mesh at all as its boundary crosses itself
    surface_deviation deviation = {};    ///< how far it is from its surface
    double least_angle_deg = 180;        ///< of a triangle's corners, where it was asked for
    std::vector<simplex<1>> chords = {}; ///< by the numbers of points in the region's boundary

    using fields = field_list<&known_mesh::inner_points, &known_mesh::triangles, &known_mesh::is_faulty,
                              &known_mesh::deviation, &known_mesh::least_angle_deg, &known_mesh::chords>;
  };

  memo<patch_mesh> meshes = {};                                           ///< all that were made
  std::unordered_map<kept<patch_mesh>, known_mesh, kept_hash> known = {}; ///< those that were asked for
};

/// Meshes of a `region_set`.
struct meshed_regions {
  std::vector<kept<patch_mesh>> of_region = {};     ///< the names of the meshes
  std::map<std::size_t, std::string> failures = {}; ///< the regions without a mesh, and why
  compressed_rows<local_id> labels = {};            ///< of each region's boundary points

  /// Calls `use(region, mesh)` for each mesh in turn; only a few are in memory.
  template <class Use>
  void for_each(const region_memo& made, const Use& use) const {
    for_each(
        made, [](std::size_t) { return true; }, use);
  }
  /// The same for the regions from `begin` to before `end`.
  template <class Use>
  void for_each(const region_memo& made, std::size_t begin, std::size_t end, const Use& use) const {
    for_each(
        made, [=](std::size_t r) { return r >= begin && r < end; }, use);
  }
  /// The same for the regions that are `wanted(region)`.
  template <class Wanted, class Use>
  void for_each(const region_memo& made, const Wanted& wanted, const Use& use) const {
    std::vector<std::size_t> regions;
    std::vector<kept<patch_mesh>> there;
    for (std::size_t r = 0; r < of_region.size(); ++r)
      if (!failures.contains(r) && wanted(r)) {
        regions.push_back(r);
        there.push_back(of_region[r]);
      }
    made.meshes.for_each(there, [&](std::size_t i, const patch_mesh& mesh) { use(regions[i], mesh); });
  }
};

/// How `mesh_regions` works, beside the mesher.
struct mesh_regions_options {
  region_attempts attempts = {}; ///< how often a region is tried
  bool parameters = true;        ///< false: the meshes come without `inner_uv`
  bool deviation = false; ///< true: meshes on CAD faces have their `surface_deviation` in their summary
  bool angles = false;    ///< true: the others have their least corner angle there
  double triangles_per_task = 4096; ///< regions are joined to tasks of about so many
  progress on_progress = {};        ///< told how the regions come along
  std::string stage = "regions";    ///< what progress and report call it
};

namespace detail {

/// Meshes a region on its surface at a size. Whoever calls it knows no mesher, and is not
/// compiled again for each.
using region_mesher = std::function<patch_mesh(const any_surface&, const surface_region&, const any_sizing&)>;

/// `mesh_regions` by such a function.
template <geometry_model Geometry, executor Executor>
meshed_regions make_regions(const Geometry& model, region_set<Geometry>& set, const region_mesher& mesh_it,
                            const refined_sizing& size, const Executor& run, region_memo& made,
                            const mesh_regions_options& options);

} // namespace detail

/// Makes the meshes that are not in `made`, through the executor; then, while two regions have an inner edge
/// between the same boundary points, or one where another's line is, forbids it to all but the first and
/// makes those again (`set.forbidden_edges` tell). A mesh is a function of its region, of the sizes near it,
/// of the model and the mesher; these two and the plain sizes must be the same for all calls with one memo. A
/// region that fails keeps none of the others from being made. Throws `usage_error` when the mesher may not
/// run in the threads of `run`.
/// Complexity: that of the surface mesher, once per region and attempt.
/// \param model what the regions are on
/// \param set the regions, and edges forbidden in them
/// \param mesher meshes a region in its parameter plane
/// \param size edge lengths wanted, in the units of the model
/// \param run carries out independent tasks; the result does not depend on it
/// \param made meshes of earlier calls; grows
/// \param options attempts and progress
template <geometry_model Geometry, surface_mesher Mesher, executor Executor>
meshed_regions mesh_regions(const Geometry& model, region_set<Geometry>& set, const Mesher& mesher,
                            const refined_sizing& size, const Executor& run, region_memo& made,
                            const mesh_regions_options& options) {
  if (runs_in_threads(run) && !may_run_in_threads(mesher))
    throw usage_error(
        "this surface mesher must not run in several threads of one process; use worker processes");
  const auto mesh_it = [&](const any_surface& surface, const surface_region& region,
                           const any_sizing& sizes) {
    return mesh_region(mesher, surface, region, sizes, options.attempts);
  };
  return detail::make_regions(model, set, mesh_it, size, run, made, options);
}

/// Calls `visit(triangle, own)` for a region's triangles: oriented along the face, named by labels and, from
/// `first_inner` on, by the region's own points, and as they are named within the region.
template <class Visit>
void for_each_triangle(std::span<const local_id> labels, bool reversed, const patch_mesh& made,
                       std::size_t first_inner, const Visit& visit) {
  const std::size_t frozen = labels.size();
  for (simplex<2> own : made.triangles) {
    if (reversed)
      std::swap(own[1], own[2]);
    simplex<2> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(own[k]);
      triangle[k] = v < frozen ? labels[v] : static_cast<local_id>(first_inner + v - frozen);
    }
    visit(triangle, own);
  }
}

/// Appends a region's own points to `points`, and calls `visit(triangle, uv)` for its triangles, with the
/// parameters of the corners where the mesh has them.
template <class Visit>
void append_region(const surface_region& region, const patch_mesh& made, std::vector<vec3>& points,
                   const Visit& visit) {
  const patch_boundary& boundary = region.boundary;
  const std::size_t frozen = boundary.labels.size(), first_inner = points.size();
  append(points, made.inner_points);
  for_each_triangle(boundary.labels, region.reversed, made, first_inner,
                    [&](const simplex<2>& triangle, const simplex<2>& own) {
                      std::array<vec2, 3> uv{};
                      for (std::size_t k = 0; k < 3; ++k)
                        if (const auto v = static_cast<std::size_t>(own[k]); v < frozen)
                          uv[k] = boundary.uv[v];
                        else if (!made.inner_uv.empty())
                          uv[k] = made.inner_uv[v - frozen];
                      visit(triangle, uv);
                    });
}

} // namespace dovetail

#include "dovetail/remesh/region_making.hpp"

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/mesh_regions.ipp"
#endif
