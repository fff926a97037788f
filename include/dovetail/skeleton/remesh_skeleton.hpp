/// @file
/// Remeshes a whole skeleton: lines first, then regions and interface faces, each once, through the executor
/// (paper, section 3.5); then puts the pieces together.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/skeleton/patches.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

/// Patches already remeshed, by the keys of their boundaries. After a merge of subdomains most patches are as
/// before.
struct patch_cache {
  content_key field; ///< what else all patches are a function of: the key of a size field that was changed
  std::map<content_key, patch_mesh> patches;
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
  std::vector<local_id> patch_of_triangle; ///< region r, or number of regions + interface face f
  std::vector<patch_failure> failures;     ///< `fine` is incomplete when there are any
  report summary;
};

/// Remeshes the skeleton to the sizing field. `cache` carries patches from one call to the next as long as
/// the model and the remesher are the same; start with an empty one. "patches_made" in the summary are those
/// that were not in it. About linear in the triangles made. Faults come back as `failures`; throws
/// `mesher_error` when a patch cannot be evaluated at all.
remeshed_skeleton remesh_skeleton(const any_geometry& model, const surface_mesh& surface,
                                  std::span<const vec3> coarse_points, const coarse_skeleton& skeleton,
                                  const any_sizing& size, const remesh::patch_remesher& remesher,
                                  const any_executor& run, patch_cache& cache,
                                  const progress& on_progress = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/remesh_skeleton.ipp"
#endif
