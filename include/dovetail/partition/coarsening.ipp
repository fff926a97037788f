/// @file
/// What `coarsening.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/coarsening.hpp"

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE coarsened_graph match_heavy_edges(const csr_graph& graph, double max_weight,
                                                  std::uint64_t seed) {
  const auto n = static_cast<std::size_t>(graph.node_count());
  std::vector<local_id> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = n; i > 1; --i) { // Fisher-Yates with a linear congruential generator
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    std::swap(order[i - 1], order[(seed >> 33) % i]);
  }
  coarsened_graph coarse;
  coarse.node_of.assign(n, no_id);
  local_id count = 0;
  for (const local_id v : order) {
    const auto i = static_cast<std::size_t>(v);
    if (coarse.node_of[i] != no_id)
      continue;
    local_id mate = no_id;
    double heaviest = 0;
    const auto row = graph.row(v);
    const auto begin = static_cast<std::size_t>(graph.offsets[i]);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto w = static_cast<std::size_t>(row[k]);
      if (coarse.node_of[w] == no_id && graph.edge_weights[begin + k] > heaviest &&
          graph.node_weights[i] + graph.node_weights[w] <= max_weight) {
        heaviest = graph.edge_weights[begin + k];
        mate = row[k];
      }
    }
    coarse.node_of[i] = count;
    if (mate != no_id)
      coarse.node_of[mate] = count;
    ++count;
  }
  coarse.graph = contract(graph, coarse.node_of, count);
  return coarse;
}

} // namespace dovetail
