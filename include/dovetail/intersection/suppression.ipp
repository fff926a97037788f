/// @file
/// What `suppression.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <set>
#include <span>

namespace dovetail {

DOVETAIL_INLINE suppression_plan plan_suppression(const fine_skeleton& skeleton,
                                                  const std::vector<bool>& planar, const any_executor& run,
                                                  const crossing_parameters& parameters) {
  const auto both_planar = [&](local_id i, local_id j) {
    return planar[static_cast<std::size_t>(i)] && planar[static_cast<std::size_t>(j)];
  };
  const auto pairs = crossing_triangles(skeleton.points, skeleton.triangles, both_planar, run, parameters);
  suppression_plan plan;
  plan.crossings = pairs.size();
  std::set<std::array<local_id, 2>> merges;
  for (const auto& [first, second] : pairs) {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    const bool inner_i = skeleton.cad_faces[i] == no_id, inner_j = skeleton.cad_faces[j] == no_id;
    if (!inner_i && !inner_j)
      plan.surface_crossings.push_back(
          detail::describe_crossing(skeleton.points, skeleton.triangles, skeleton.cad_faces, i, j));
    else if (inner_i && inner_j)
      merges.insert(std::min(skeleton.subdomains[i], skeleton.subdomains[j]));
    else
      merges.insert(skeleton.subdomains[inner_i ? i : j]);
  }
  plan.merges.assign(merges.begin(), merges.end());
  return plan;
}

} // namespace dovetail
