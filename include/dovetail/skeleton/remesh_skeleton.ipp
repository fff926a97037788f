/// @file
/// What `remesh_skeleton.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/surface_deviation.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"
#include "dovetail/skeleton/skeleton_assembly.hpp"

#include <utility>

namespace dovetail {

DOVETAIL_INLINE std::vector<local_id> faces_with_small_angles(const skeleton_patches& patches,
                                                              const coarse_skeleton& skeleton,
                                                              const region_memo& made, double threshold_deg) {
  std::vector<local_id> faces;
  for (std::size_t f = 0; f < skeleton.faces.size(); ++f)
    if (made.known.at(patches.meshes.of_region[skeleton.regions.size() + f]).least_angle_deg < threshold_deg)
      faces.push_back(static_cast<local_id>(f));
  return faces;
}

DOVETAIL_INLINE remeshed_skeleton detail::with_counts(const patches_to_join& of,
                                                      const skeleton_assembly& assembly, fine_skeleton fine,
                                                      skeleton_patches&& patches) {
  remeshed_skeleton result;
  result.fine = std::move(fine);
  result.patches.line_points = static_cast<local_id>(of.lines.points.size());
  for (const std::size_t first : assembly.first_triangles())
    result.patches.first_triangle.push_back(static_cast<local_id>(first));
  report deviation;
  for (std::size_t p = 0; p < of.coarse.regions.size(); ++p)
    note_deviation(deviation, "face " + std::to_string(of.coarse.regions[p].cad_face),
                   of.made.known.at(patches.meshes.of_region[p]).deviation);
  result.patches.of_patch = std::move(patches.meshes.of_region);
  result.patches.failures = std::move(patches.failures);
  warn_of_deviations(result.summary, deviation);
  result.summary.children.push_back(std::move(deviation));
  result.counts = {.interface_faces = of.coarse.faces.size(),
                   .triangles = result.fine.sides.size(),
                   .points = result.fine.points.size(),
                   .patches_made = patches.made};
  result.summary.set(result.counts);
  return result;
}

} // namespace dovetail
