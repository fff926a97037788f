/// @file
/// What `finishing.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/partition/refinement.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE void require_imbalance(double imbalance) {
  if (!(imbalance >= 1))
    throw partition_error("the imbalance asked for is " + number_text(imbalance) +
                          "; it is the heaviest part over the average part, so give 1 or more");
}

DOVETAIL_INLINE void require_coarse_nodes(int per_part) {
  if (per_part < 2)
    throw partition_error("coarsening is to stop at " + std::to_string(per_part) +
                          " nodes per part, with which a part may get none; give 2 or more");
}

DOVETAIL_INLINE double allowed_part_weight(const csr_graph& graph, int parts, double imbalance) {
  const auto& weights = graph.node_weights;
  const double average = std::accumulate(weights.begin(), weights.end(), 0.0) / parts;
  return std::max(imbalance * average, average + *std::max_element(weights.begin(), weights.end()));
}

DOVETAIL_INLINE void level_parts(const csr_graph& graph, std::span<local_id> part, int parts,
                                 double imbalance) {
  const double allowed = allowed_part_weight(graph, parts, imbalance) * (1 + 1e-12);
  auto weights = part_weights(graph, part, parts);
  std::set<std::pair<double, std::size_t>> by_weight;
  for (std::size_t p = 0; p < weights.size(); ++p)
    by_weight.insert({weights[p], p});
  const auto change = [&](std::size_t p, double by) {
    by_weight.erase({weights[p], p});
    weights[p] += by;
    by_weight.insert({weights[p], p});
  };
  for (std::size_t v = 0; v < part.size(); ++v) {
    const auto from = static_cast<std::size_t>(part[v]);
    if (weights[from] <= allowed || graph.node_weights[v] <= 0)
      continue;
    const std::size_t to = by_weight.begin()->second;
    change(from, -graph.node_weights[v]);
    change(to, graph.node_weights[v]);
    part[v] = static_cast<local_id>(to);
  }
}

DOVETAIL_INLINE void finish_partition(const csr_graph& graph, std::span<local_id> part, int parts,
                                      double imbalance, int passes) {
  fill_empty_parts(graph, part, parts);
  partition_refiner(graph, part, equal_limits(graph, parts, imbalance)).refine(passes);
  level_parts(graph, part, parts, imbalance);
}

} // namespace dovetail::detail
