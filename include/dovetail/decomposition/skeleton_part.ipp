/// @file
/// What `skeleton_part.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/decomposition/skeleton_part.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
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

DOVETAIL_INLINE std::vector<bool> points_with_surroundings(const simplicial_mesh<3>& mesh,
                                                           std::span<const local_id> subdomain_of_element,
                                                           std::span<const local_id> wanted) {
  const auto box_of = [&](std::size_t e) {
    box3 box;
    for (const local_id v : mesh.elements[e])
      box.include(mesh.points[v]);
    return box;
  };
  std::vector<bool> points(mesh.points.size(), false);
  const auto take = [&](std::size_t e) {
    for (const local_id v : mesh.elements[e])
      points[v] = true;
  };
  std::vector<box3> reach;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::binary_search(wanted.begin(), wanted.end(), subdomain_of_element[e])) {
      take(e);
      reach.push_back(inflated(box_of(e), box_of(e).diagonal() / 2));
    }
  const box_tree in_reach(reach);
  const std::vector<bool> of_wanted = points;
  std::set<local_id> touching;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::any_of(mesh.elements[e].begin(), mesh.elements[e].end(),
                    [&](local_id v) { return of_wanted[v]; }))
      touching.insert(subdomain_of_element[e]);
    else if (in_reach.any_overlaps(reach, box_of(e)))
      take(e);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (touching.contains(subdomain_of_element[e]))
      take(e);
  return points;
}

} // namespace dovetail
