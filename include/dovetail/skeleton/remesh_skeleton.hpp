/// @file
/// Remeshes a whole skeleton: lines first, then regions and interface faces, each once, through the executor
/// (paper, section 3.5); then puts the pieces together.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/parallel/batched_entities.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/skeleton/patches.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

/// The lines and patches made so far, by their keys. After a merge of subdomains most are as before.
struct skeleton_store {
  explicit skeleton_store(const std::shared_ptr<entity_store>& store) : lines(store), patches(store) {}

  batched_entities lines;
  batched_entities patches;
  std::vector<content_key> patches_apart; ///< growing; of a skeleton of which no two triangles cross
};

/// A region or face that could not be remeshed, and lines on CAD faces at the fault that a merge would
/// remove.
struct patch_failure {
  local_id region = no_id;               ///< or no_id
  local_id face = no_id;                 ///< or no_id
  std::vector<local_id> removable_lines; ///< lines at the fault that do not lie on CAD curves
  std::string reason;
};

struct remeshed_skeleton {
  fine_skeleton fine;
  /// Per patch, of which the regions come first and the interface faces behind them: its first triangle in
  /// `fine`; and the end.
  std::vector<local_id> first_triangle;
  std::vector<content_key> patch_keys;
  std::vector<patch_failure> failures; ///< `fine` is incomplete when there are any
  report summary;
};

/// Remeshes the skeleton to the sizing field, of which `field` is the key. `made` carries lines and patches
/// from one call to the next as long as the model and the mesher are the same. "patches_made" in the
/// summary are those that were not in it. About linear in the triangles made. Faults come back as `failures`;
/// throws `mesher_error` when a patch cannot be evaluated at all.
remeshed_skeleton remesh_skeleton(const any_geometry& model, const surface_mesh& surface,
                                  std::span<const vec3> coarse_points, const coarse_skeleton& skeleton,
                                  const any_sizing& size, content_key field, const any_surface_mesher& mesher,
                                  const any_executor& run, skeleton_store& made,
                                  const progress& on_progress = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/remesh_skeleton.ipp"
#endif
