/// @file
/// The parts of a triangulated surface that no feature edge runs through.
#pragma once

#include "dovetail/geometry/discrete_cluster_measures.hpp"
#include "dovetail/geometry/discrete_loops.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace dovetail::discrete {

/// Floods over pairs of neighbours that `joined(t, next)`; numbers the clusters in the order of their first
/// triangles. `neighbours`: the triangle across the edge opposite each corner, or no_id. Linear.
template <class Joined>
std::vector<local_id> clusters(const std::vector<std::array<local_id, 3>>& neighbours, Joined&& joined) {
  std::vector<local_id> cluster(neighbours.size(), no_id);
  std::vector<std::size_t> pending;
  local_id count = 0;
  for (std::size_t seed = 0; seed < cluster.size(); ++seed) {
    if (cluster[seed] != no_id)
      continue;
    cluster[seed] = count;
    pending.assign(1, seed);
    while (!pending.empty()) {
      const std::size_t t = pending.back();
      pending.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const auto next = static_cast<std::size_t>(neighbours[t][i]);
        if (next != nowhere && cluster[next] == no_id && joined(t, next)) {
          cluster[next] = count;
          pending.push_back(next);
        }
      }
    }
    ++count;
  }
  return cluster;
}

/// The smooth area of each triangle: neighbours of one named group that turn by no more than the angle are
/// in one. A sliver, which has no normal, joins them.
inline std::vector<local_id> smooth_areas(const cluster_measures& measures,
                                          const std::vector<std::array<local_id, 3>>& neighbours,
                                          const std::vector<local_id>& group_of, double feature_angle_deg) {
  return clusters(neighbours, [&](std::size_t t, std::size_t next) {
    if (group_of[t] != group_of[next])
      return false;
    return measures.is_sliver(t) || measures.is_sliver(next) ||
           angle_between(measures.area_vector(t), measures.area_vector(next)) <=
               feature_angle_deg * radians_per_degree;
  });
}

} // namespace dovetail::discrete
