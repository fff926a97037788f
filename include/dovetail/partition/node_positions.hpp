/// @file
/// What partitioners that go by place have in common.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/partition/recursive_bisection.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace dovetail::detail {

/// Throws `partition_error` unless every node has a finite position. `name` is the partitioner's.
inline void require_positions(const csr_graph& graph, const std::string& name) {
  if (graph.positions.size() != graph.node_weights.size())
    throw partition_error("the partitioner " + name + " goes by the nodes' positions, but the graph has " +
                          std::to_string(graph.positions.size()) + " positions for " +
                          std::to_string(graph.node_weights.size()) +
                          " nodes; fill csr_graph::positions or use another partitioner");
  for (std::size_t v = 0; v < graph.positions.size(); ++v)
    if (const vec3 p = graph.positions[v]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw partition_error("the position of node " + std::to_string(v) +
                            " is not finite; give finite coordinates");
}

/// The smallest box around all nodes.
inline box3 box_of_positions(const csr_graph& graph) {
  box3 box;
  for (const vec3& p : graph.positions)
    box.include(p);
  return box;
}

/// Parameters of `bisect_by_place`.
struct place_options {
  double imbalance; ///< heaviest part over average part
  int refinement_passes;
};

/// The partitioner `who` that bisects by a rule about the positions.
template <bisection_rule Bisect>
std::vector<local_id> bisect_by_place(const csr_graph& graph, int parts, const char* who,
                                      const Bisect& bisect, const place_options& options) {
  require_partitionable(graph, parts);
  require_imbalance(options.imbalance);
  require_positions(graph, who);
  std::vector<local_id> part = recursive_bisection(graph, parts, bisect);
  finish_partition(graph, part, parts, options.imbalance, options.refinement_passes);
  return part;
}

} // namespace dovetail::detail
