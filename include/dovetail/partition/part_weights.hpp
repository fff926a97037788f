/// @file
/// What partitioners have in common: part weights, the weight limit, filling empty parts.
#pragma once

#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/graph/require_valid_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace dovetail {

/// Sum of the node weights of each part.
template <weighted_graph G>
std::vector<double> part_weights(const G& graph, std::span<const local_id> part, int parts) {
  std::vector<double> weights(static_cast<std::size_t>(parts), 0.0);
  for (std::size_t v = 0; v < part.size(); ++v)
    weights[part[v]] += graph.node_weight(static_cast<local_id>(v));
  return weights;
}

/// Heaviest part over average part; 1 is perfect.
/// Linear. Throws nothing.
/// \param graph with weights of nodes
/// \param part per node its part, from 0
/// \param parts how many there are
template <weighted_graph G>
double imbalance_of(const G& graph, std::span<const local_id> part, int parts) {
  const auto weights = part_weights(graph, part, parts);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  return total > 0 ? *std::max_element(weights.begin(), weights.end()) * parts / total : 1.0;
}

/// Sum of the weights of edges between different parts.
/// Linear. Throws nothing.
/// \param graph with weights of edges
/// \param part per node its part, from 0
template <weighted_graph G>
double edge_cut(const G& graph, std::span<const local_id> part) {
  double cut = 0;
  for (local_id v = 0; v < static_cast<local_id>(graph.node_count()); ++v)
    graph.for_each_edge(v, [&](local_id w, double weight) {
      if (v < w && part[v] != part[w])
        cut += weight;
    });
  return cut;
}

namespace detail {

/// The checks that every partitioner makes first. `weights` are those of `nodes` nodes, or of some of them
/// from `first` on.
void require_partitionable(local_id nodes, std::span<const double> weights, int parts, local_id first = 0);
inline void require_partitionable(const csr_graph& graph, int parts) {
  require_valid_graph(graph);
  require_partitionable(graph.node_count(), graph.node_weights, parts);
}

/// Gives every empty part one node: the heaviest one (ties: the first) of the heaviest part with at least two
/// nodes. About n log n.
void fill_empty_parts(const csr_graph& graph, std::span<local_id> part, int parts);

} // namespace detail
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/part_weights.ipp"
#endif
