/// @file
/// What `node_positions.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/partition/node_positions.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace dovetail::detail {

DOVETAIL_INLINE void require_positions(const csr_graph& graph, const std::string& name) {
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

DOVETAIL_INLINE box3 box_of_positions(const csr_graph& graph) {
  box3 box;
  for (const vec3& p : graph.positions)
    box.include(p);
  return box;
}

} // namespace dovetail::detail
