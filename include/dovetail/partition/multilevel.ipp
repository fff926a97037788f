/// @file
/// What `multilevel.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/coarsening.hpp"
#include "dovetail/partition/multilevel.hpp"

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<coarsened_graph> coarsened_levels(const csr_graph& graph, int parts,
                                                              const multilevel_options& options) {
  const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
  const auto target = static_cast<std::int64_t>(options.coarse_nodes_per_part) * parts;
  std::vector<coarsened_graph> levels;
  while (true) {
    const csr_graph& finer = levels.empty() ? graph : levels.back().graph;
    if (finer.node_count() <= target)
      break;
    coarsened_graph coarser =
        match_heavy_edges(finer, 1.5 * total / static_cast<double>(target), options.seed + levels.size());
    if (coarser.graph.node_count() > std::int64_t{finer.node_count()} * 19 / 20)
      break; // nothing left to match
    levels.push_back(std::move(coarser));
  }
  return levels;
}

} // namespace dovetail
