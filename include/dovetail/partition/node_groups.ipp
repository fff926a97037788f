/// @file
/// What `node_groups.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/node_groups.hpp"

#include <cstdint>

namespace dovetail {

DOVETAIL_INLINE node_groups::node_groups(const csr_graph& graph, std::span<const local_id> group, int groups)
    : graph_(graph), group_(group),
      nodes_(sorted_into_rows<local_id>(static_cast<std::size_t>(groups),
                                        [&](const auto& put) {
                                          for (std::size_t v = 0; v < group.size(); ++v)
                                            put(group[v], static_cast<local_id>(v));
                                        })),
      place_(group.size()) {
  for (std::size_t g = 0; g < nodes_.size(); ++g) {
    const auto row = nodes(g);
    for (std::size_t k = 0; k < row.size(); ++k)
      place_[row[k]] = static_cast<local_id>(k);
  }
}

DOVETAIL_INLINE std::vector<local_id> node_groups::counts() const {
  std::vector<local_id> counts;
  for (std::size_t g = 0; g < nodes_.size(); ++g)
    counts.push_back(static_cast<local_id>(nodes(g).size()));
  return counts;
}

DOVETAIL_INLINE csr_graph node_groups::graph_of(std::size_t group) const {
  csr_graph own;
  for (const local_id v : nodes(group)) {
    own.node_weights.push_back(graph_.node_weights[v]);
    if (!graph_.positions.empty())
      own.positions.push_back(graph_.positions[v]);
    graph_.for_each_edge(v, [&](local_id other, double weight) {
      if (group_[other] != group_[v])
        return;
      own.neighbours.push_back(place_[other]);
      own.edge_weights.push_back(weight);
    });
    own.offsets.push_back(static_cast<std::int64_t>(own.neighbours.size()));
  }
  return own;
}

DOVETAIL_INLINE std::vector<local_id>
node_groups::joined(std::span<const std::vector<local_id>> parts_of_group,
                    std::span<const int> counts) const {
  std::vector<local_id> part(node_count());
  local_id first = 0;
  for (std::size_t g = 0; g < nodes_.size(); ++g) {
    const auto row = nodes(g);
    for (std::size_t k = 0; k < row.size(); ++k)
      part[row[k]] = first + parts_of_group[g][k];
    first += counts[g];
  }
  return part;
}

} // namespace dovetail
