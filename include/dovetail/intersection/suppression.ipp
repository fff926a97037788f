/// @file
/// What `suppression.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/intersection/triangle_blocks.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <set>
#include <span>

namespace dovetail {

namespace detail {

DOVETAIL_INLINE surface_crossing describe_crossing(std::span<const vec3> points,
                                                   std::span<const simplex<2>> triangles,
                                                   std::span<const local_id> cad_faces, std::size_t i,
                                                   std::size_t j) {
  surface_crossing crossing{{cad_faces[i], cad_faces[j]}, {}, 0};
  for (const std::size_t t : {i, j})
    for (std::size_t k = 0; k < 3; ++k) {
      const vec3 a = points[triangles[t][k]];
      const vec3 b = points[triangles[t][(k + 1) % 3]];
      crossing.center += a / 6.0;
      crossing.size += distance(a, b) / 6.0;
    }
  return crossing;
}

DOVETAIL_INLINE std::vector<local_id> triangles_to_search(const fine_skeleton& skeleton,
                                                          const known_apart& known) {
  const box_tree others(known.around_others);
  const auto is_near_others = [&](const box3& box) { return others.any_overlaps(known.around_others, box); };
  const triangle_blocks blocks(skeleton.points, skeleton.sides);
  std::vector<local_id> near;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const bool may_be_near = is_near_others(blocks.box(b));
    blocks.for_each(b, [&](local_id triangle) {
      const auto t = static_cast<std::size_t>(triangle);
      if (!known.triangles[t] || (may_be_near && is_near_others(box_of(skeleton.points, skeleton.sides[t]))))
        near.push_back(triangle);
    });
  }
  return near;
}

DOVETAIL_INLINE suppression_plan plan_for(const fine_skeleton& skeleton,
                                          const std::vector<triangle_pair>& pairs) {
  suppression_plan plan;
  plan.crossings = pairs.size();
  std::set<std::array<local_id, 2>> merges;
  for (const auto& [first, second] : pairs) {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    const bool inner_i = skeleton.side_hosts[i] == no_id, inner_j = skeleton.side_hosts[j] == no_id;
    (inner_i || inner_j ? plan.interface_crossings : plan.surface_crossings)
        .push_back(describe_crossing(skeleton.points, skeleton.sides, skeleton.side_hosts, i, j));
    if (inner_i && inner_j)
      merges.insert(std::min(skeleton.subdomains[i], skeleton.subdomains[j]));
    else if (inner_i || inner_j)
      merges.insert(skeleton.subdomains[inner_i ? i : j]);
  }
  plan.merges.assign(merges.begin(), merges.end());
  return plan;
}

} // namespace detail

DOVETAIL_INLINE known_apart known_from_patches(const fine_skeleton& skeleton,
                                               std::span<const local_id> first_triangle,
                                               std::span<const kept<patch_mesh>> patches,
                                               std::span<const kept<patch_mesh>> apart) {
  known_apart known;
  if (apart.empty())
    return known;
  known.triangles.resize(skeleton.sides.size(), false);
  for (std::size_t p = 0; p < patches.size(); ++p)
    if (std::binary_search(apart.begin(), apart.end(), patches[p])) {
      std::fill(known.triangles.begin() + first_triangle[p], known.triangles.begin() + first_triangle[p + 1],
                true);
    } else {
      box3& box = known.around_others.emplace_back();
      for (local_id t = first_triangle[p]; t < first_triangle[p + 1]; ++t)
        for (const local_id v : skeleton.sides[t])
          box.include(skeleton.points[v]);
    }
  return known;
}

} // namespace dovetail
