/// @file
/// What `skeleton_part.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/decomposition/skeleton_part.hpp"

#include <algorithm>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE coarse_skeleton part_at_points(coarse_skeleton skeleton, const surface_mesh& surface,
                                               const std::vector<bool>& is_wanted) {
  std::vector<bool> is_in_part(is_wanted.size(), false);
  const auto has_wanted = [&](const simplex<2>& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](local_id v) { return is_wanted[v]; });
  };
  const auto take = [&](const simplex<2>& triangle) {
    for (const local_id v : triangle)
      is_in_part[v] = true;
  };
  const auto triangle_of = [&](local_id t) -> const simplex<2>& { return surface.mesh.elements[t]; };
  std::erase_if(skeleton.regions, [&](const skeleton_region& region) {
    return std::none_of(region.triangles.begin(), region.triangles.end(),
                        [&](local_id t) { return has_wanted(triangle_of(t)); });
  });
  std::erase_if(skeleton.faces, [&](const skeleton_face& face) { return !has_wanted(face.vertices); });
  for (const skeleton_region& region : skeleton.regions)
    for (const local_id t : region.triangles)
      take(triangle_of(t));
  for (const skeleton_face& face : skeleton.faces)
    take(face.vertices);
  std::erase_if(skeleton.lines, [&](const skeleton_line& line) {
    return !is_in_part[line.vertices[0]] || !is_in_part[line.vertices[1]];
  });
  return skeleton;
}

} // namespace dovetail
