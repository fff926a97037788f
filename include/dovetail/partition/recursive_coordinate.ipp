/// @file
/// What `recursive_coordinate.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/node_positions.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"

#include <vector>

namespace dovetail::partition {

DOVETAIL_INLINE std::vector<local_id> recursive_coordinate::across_longest_side(const csr_graph& graph,
                                                                                int left, int right) {
  const box3 box = detail::box_of_positions(graph);
  const vec3 extent = box.upper - box.lower;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::vector<double> keys;
  keys.reserve(graph.positions.size());
  for (const vec3& p : graph.positions)
    keys.push_back(p[axis]);
  return bisect_by_key(graph, keys, left, right);
}

} // namespace dovetail::partition
