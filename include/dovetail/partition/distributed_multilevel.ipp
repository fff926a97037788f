/// @file
/// What `distributed_multilevel.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/distributed_multilevel.hpp"
#include "dovetail/partition/integer_weights.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE graph_sums sums_of(any_communicator& network, const csr_graph& rows) {
  graph_sums all;
  for (const graph_sums& more :
       network.all_gather(graph_sums{sums_of(rows.node_weights), sums_of(rows.edge_weights)})) {
    all.nodes.add(more.nodes);
    all.edges.add(more.edges);
  }
  return all;
}

DOVETAIL_INLINE bool keeps_promise(any_communicator& network, const csr_graph& rows,
                                   const std::vector<local_id>& part, int parts, double most) {
  std::vector<double> nodes(static_cast<std::size_t>(parts), 0);
  for (const local_id p : part)
    ++nodes[p];
  const auto add = [](const std::vector<double>& from, std::vector<double>& to) {
    std::transform(from.begin(), from.end(), to.begin(), to.begin(), std::plus<>());
  };
  std::vector<double> all_nodes(nodes.size(), 0), weights(nodes.size(), 0);
  for (const auto& [their_nodes, their_weights] :
       network.all_gather(std::pair(nodes, part_weights(rows, part, parts)))) {
    add(their_nodes, all_nodes);
    add(their_weights, weights);
  }
  return *std::min_element(all_nodes.begin(), all_nodes.end()) > 0 &&
         *std::max_element(weights.begin(), weights.end()) <= most * (1 + 1e-12);
}

} // namespace dovetail::detail
