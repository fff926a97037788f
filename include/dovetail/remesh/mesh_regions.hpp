/// @file
/// The step from regions with frozen boundaries to their meshes: of the faces of a coarse surface, of the
/// regions and interface faces of a skeleton, and of the regions of a piece of D = 2.
///
/// Whoever the surface mesher is, all climb the same ladder: again without the edges that another region has
/// as well (chords), again with smaller sizes inside where triangles are folded over; what is left of such
/// edges is split, and the result is checked. What is wrong after that is handed back as data.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/batched_entities.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/remesh/surface_region.hpp"
#include "dovetail/sizing/refined_sizing.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// How often a region is tried before its faults are handed back.
struct region_attempts {
  int chords = 6; ///< times again without inner edges that must not be
  int folds = 6;  ///< times again with sizes inside 0.8 times those before, while triangles are folded over
};

/// Meshes one region on its surface, and again as long as `attempts` allow; of attempts with folds the one
/// with the fewest. Inner edges that must not be are split where the mesher did not avoid them: those that
/// are forbidden, and those that join two boundary points a second time. Costs what the mesher does. Throws
/// `mesher_error` when a segment of the boundary is not a side of exactly one triangle or a side inside not
/// one of two, and what the mesher throws.
patch_mesh mesh_region(const any_surface_mesher& mesher, const any_surface& surface,
                       const surface_region& region, const any_sizing& size, const region_attempts& attempts);

/// What is wrong with a region that is folded over still.
inline std::string folds_of(const patch_mesh& made) {
  return std::to_string(made.folded.size()) +
         " triangles stay folded over; repair the face or give a smaller size there";
}

/// Regions that share boundary points, by the same labels. Their boundaries together are as large as their
/// meshes, so each is built when it is needed and not held.
struct region_set {
  std::size_t count = 0;
  std::function<surface_region(std::size_t)> build; ///< without `surface` and `forbids`; pure
  /// The surface of a region, from a model of the worker's own.
  std::function<any_surface(const any_geometry&, std::size_t)> surface_of;
  /// What the surface of each region is a function of beside its face and boundary; empty where there is
  /// nothing.
  std::vector<content_key> surface_keys = {};
  /// Edges that a region must not have since another one has them; `mesh_regions` adds to them.
  std::map<std::size_t, std::vector<simplex<1>>> forbidden_edges = {};

  surface_region region(std::size_t r) const {
    surface_region built = build(r);
    if (const auto more = forbidden_edges.find(r); more != forbidden_edges.end())
      append(built.boundary.forbidden_edges, more->second);
    return built;
  }
};

/// Meshes of a `region_set`, in a store.
struct meshed_regions {
  std::vector<content_key> keys = {};               ///< of the meshes
  std::map<std::size_t, std::string> failures = {}; ///< the regions without a mesh, and why

  /// Calls `use(region, mesh)` for each mesh in turn; only a few are in memory.
  template <class Use>
  void for_each(const batched_entities& store, const Use& use) const {
    std::vector<std::size_t> regions;
    std::vector<content_key> there;
    for (std::size_t r = 0; r < keys.size(); ++r)
      if (!failures.contains(r)) {
        regions.push_back(r);
        there.push_back(keys[r]);
      }
    store.for_each(
        there, [&](std::size_t i, const byte_buffer& bytes) { use(regions[i], decode_patch_mesh(bytes)); });
  }
};

/// How `mesh_regions` works, beside the mesher.
struct mesh_regions_options {
  region_attempts attempts = {};
  bool parameters = true; ///< false: the meshes come without `inner_uv`
  bool deviation = false; ///< true: meshes on CAD faces have their `surface_deviation` in their summary
  double triangles_per_task = 4096;
  progress on_progress = {};
  std::string stage = "regions";
};

/// Makes the meshes that are not in `store`, through the executor; then, while two regions have an inner edge
/// between the same boundary points, or one where another's line is, forbids it to all but the first and
/// makes those again (`set.forbidden_edges` tell). A mesh is a function of its region, of the sizes near it,
/// of the model and the mesher; these two and the plain sizes must be the same for all calls with a store. A
/// region that fails keeps none of the others from being made. Throws `usage_error` when the mesher may not
/// run in the threads of `run`.
meshed_regions mesh_regions(const any_geometry& model, region_set& set, const any_surface_mesher& mesher,
                            const refined_sizing& size, const any_executor& run, batched_entities& store,
                            const mesh_regions_options& options);

/// Appends a region's own points to `points`, and calls `visit(triangle, uv)` for its triangles: oriented
/// along the face, named by labels and by the places in `points`, with the parameters of their corners where
/// the mesh has them.
template <class Visit>
void append_region(const surface_region& region, const patch_mesh& made, std::vector<vec3>& points,
                   const Visit& visit) {
  const patch_boundary& boundary = region.boundary;
  const std::size_t frozen = boundary.labels.size();
  const std::size_t first_inner = points.size();
  append(points, made.inner_points);
  for (simplex<2> triangle : made.triangles) {
    if (region.reversed)
      std::swap(triangle[1], triangle[2]);
    std::array<vec2, 3> uv{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangle[k]);
      if (v < frozen)
        uv[k] = boundary.uv[v];
      else if (!made.inner_uv.empty())
        uv[k] = made.inner_uv[v - frozen];
      triangle[k] = v < frozen ? boundary.labels[v] : static_cast<local_id>(first_inner + v - frozen);
    }
    visit(triangle, uv);
  }
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/mesh_regions.ipp"
#endif
