/// @file
/// What `bisection.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/graph/breadth_first.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/partition/bisection.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/partition/refinement.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The node that a breadth-first search from `start` reaches last.
inline local_id farthest_node(const csr_graph& graph, local_id start) {
  return breadth_first_order(graph, start).back();
}

/// Grows part 0 from `start`, always by the node whose move costs the cut least, to the weight `target`; all
/// other nodes are part 1. At least one node stays in each part.
inline std::vector<local_id> grow_part(const csr_graph& graph, local_id start, double target) {
  const auto n = static_cast<std::size_t>(graph.node_count());
  std::vector<local_id> part(n, 1);
  std::vector<double> gain(n, 0.0); // edges to part 0 minus edges to part 1
  for (std::size_t v = 0; v < n; ++v)
    for (std::int64_t k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k)
      gain[v] -= graph.edge_weights[k];
  std::priority_queue<std::pair<double, local_id>> frontier; // by gain, then the smaller node
  frontier.emplace(gain[start], -start);
  double weight = 0;
  std::size_t taken = 0;
  std::size_t next_unreached = 0;
  while (taken + 1 < n && weight < target) {
    if (frontier.empty()) { // the component is used up: go on in the next one
      while (part[next_unreached] == 0)
        ++next_unreached;
      frontier.emplace(gain[next_unreached], -static_cast<local_id>(next_unreached));
    }
    const auto [promised, negated] = frontier.top();
    frontier.pop();
    const auto v = static_cast<std::size_t>(-negated);
    if (part[v] == 0 || promised < gain[v])
      continue;
    const double after = weight + graph.node_weights[v];
    if (taken > 0 && after - target > target - weight)
      break; // closer to the target without it
    part[v] = 0;
    weight = after;
    ++taken;
    const auto row = graph.row(static_cast<local_id>(v));
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto w = static_cast<std::size_t>(row[k]);
      gain[w] += 2 * graph.edge_weights[static_cast<std::size_t>(graph.offsets[v]) + k];
      if (part[w] == 1)
        frontier.emplace(gain[w], -row[k]);
    }
  }
  return part;
}

DOVETAIL_INLINE std::vector<local_id> bisect(const csr_graph& graph, double fraction, double imbalance) {
  const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
  const local_id n = graph.node_count();
  const local_id end = farthest_node(graph, 0);
  const std::vector<double> limits{imbalance * fraction * total, imbalance * (1 - fraction) * total};
  std::vector<local_id> best;
  std::pair<double, double> best_score;
  for (const local_id start : {end, farthest_node(graph, end), static_cast<local_id>(n / 3),
                               static_cast<local_id>(n / 2), static_cast<local_id>(2 * (n / 3))}) {
    std::vector<local_id> part = grow_part(graph, start, fraction * total);
    partition_refiner(graph, part, limits).refine();
    const auto weights = part_weights(graph, part, 2);
    const double excess = std::max({0.0, weights[0] - limits[0], weights[1] - limits[1]});
    const std::pair score(excess, edge_cut(graph, part));
    if (best.empty() || score < best_score) {
      best = std::move(part);
      best_score = score;
    }
  }
  return best;
}

} // namespace dovetail::detail
