/// @file
/// What partitioners have in common: part weights, the weight limit, filling empty parts.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/graph/csr_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

/// Sum of the node weights of each part.
inline std::vector<double> part_weights(const csr_graph& graph, std::span<const local_id> part, int parts) {
  std::vector<double> weights(static_cast<std::size_t>(parts), 0.0);
  for (std::size_t v = 0; v < part.size(); ++v)
    weights[static_cast<std::size_t>(part[v])] += graph.node_weights[v];
  return weights;
}

/// Heaviest part over average part; 1 is perfect.
inline double imbalance_of(const csr_graph& graph, std::span<const local_id> part, int parts) {
  const auto weights = part_weights(graph, part, parts);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  return total > 0 ? *std::max_element(weights.begin(), weights.end()) * parts / total : 1.0;
}

/// Sum of the weights of edges between different parts.
inline double edge_cut(const csr_graph& graph, std::span<const local_id> part) {
  double cut = 0;
  for (local_id v = 0; v < graph.node_count(); ++v) {
    const auto row = graph.row(v);
    const auto begin = static_cast<std::size_t>(graph.offsets[static_cast<std::size_t>(v)]);
    for (std::size_t k = 0; k < row.size(); ++k)
      if (v < row[k] && part[static_cast<std::size_t>(v)] != part[static_cast<std::size_t>(row[k])])
        cut += graph.edge_weights[begin + k];
  }
  return cut;
}

namespace detail {

/// The checks that every partitioner makes first.
inline void require_partitionable(const csr_graph& graph, int parts) {
  if (parts < 1)
    throw partition_error("cannot make " + std::to_string(parts) + " parts; ask for at least one");
  if (graph.node_count() < parts)
    throw partition_error("cannot make " + std::to_string(parts) + " parts of a graph with " +
                          std::to_string(graph.node_count()) +
                          " nodes; ask for fewer parts or refine the coarse mesh");
  for (std::size_t v = 0; v < graph.node_weights.size(); ++v)
    if (!(graph.node_weights[v] >= 0) || graph.node_weights[v] > 1e300)
      throw partition_error("node " + std::to_string(v) + " has weight " +
                            std::to_string(graph.node_weights[v]) +
                            "; weights must be finite and not negative");
}

/// Gives every empty part one node: the heaviest one of the heaviest part with at least two nodes.
inline void fill_empty_parts(const csr_graph& graph, std::span<local_id> part, int parts) {
  std::vector<local_id> counts(static_cast<std::size_t>(parts), 0);
  for (const local_id p : part)
    ++counts[static_cast<std::size_t>(p)];
  auto weights = part_weights(graph, part, parts);
  for (std::size_t empty = 0; empty < counts.size(); ++empty) {
    if (counts[empty] > 0)
      continue;
    std::size_t donor = counts.size();
    for (std::size_t p = 0; p < counts.size(); ++p)
      if (counts[p] > 1 && (donor == counts.size() || weights[p] > weights[donor]))
        donor = p;
    std::size_t given = part.size();
    for (std::size_t v = 0; v < part.size(); ++v)
      if (static_cast<std::size_t>(part[v]) == donor &&
          (given == part.size() || graph.node_weights[v] > graph.node_weights[given]))
        given = v;
    part[given] = static_cast<local_id>(empty);
    --counts[donor];
    ++counts[empty];
    weights[donor] -= graph.node_weights[given];
    weights[empty] += graph.node_weights[given];
  }
}

} // namespace detail
} // namespace dovetail
