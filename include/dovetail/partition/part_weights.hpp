/// @file
/// What partitioners have in common: part weights, the weight limit, filling empty parts.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/graph/require_valid_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Sum of the node weights of each part.
template <weighted_graph G>
std::vector<double> part_weights(const G& graph, std::span<const local_id> part, int parts) {
  std::vector<double> weights(static_cast<std::size_t>(parts), 0.0);
  for (std::size_t v = 0; v < part.size(); ++v)
    weights[static_cast<std::size_t>(part[v])] += graph.node_weight(static_cast<local_id>(v));
  return weights;
}

/// Heaviest part over average part; 1 is perfect.
template <weighted_graph G>
double imbalance_of(const G& graph, std::span<const local_id> part, int parts) {
  const auto weights = part_weights(graph, part, parts);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  return total > 0 ? *std::max_element(weights.begin(), weights.end()) * parts / total : 1.0;
}

/// Sum of the weights of edges between different parts.
template <weighted_graph G>
double edge_cut(const G& graph, std::span<const local_id> part) {
  double cut = 0;
  for (local_id v = 0; v < static_cast<local_id>(graph.node_count()); ++v)
    graph.for_each_edge(v, [&](local_id w, double weight) {
      if (v < w && part[static_cast<std::size_t>(v)] != part[static_cast<std::size_t>(w)])
        cut += weight;
    });
  return cut;
}

namespace detail {

/// The checks that every partitioner makes first. `weights` are those of `nodes` nodes, or of some of them
/// from `first` on.
inline void require_partitionable(local_id nodes, std::span<const double> weights, int parts,
                                  local_id first = 0) {
  if (parts < 1)
    throw partition_error("cannot make " + std::to_string(parts) + " parts; ask for at least one");
  if (nodes < parts)
    throw partition_error("cannot make " + std::to_string(parts) + " parts of a graph with " +
                          std::to_string(nodes) + " nodes; ask for fewer parts or refine the coarse mesh");
  for (std::size_t v = 0; v < weights.size(); ++v)
    if (!(weights[v] >= 0) || weights[v] > 1e300)
      throw partition_error("node " + std::to_string(static_cast<std::size_t>(first) + v) + " has weight " +
                            number_text(weights[v]) + "; weights must be finite and not negative");
}
inline void require_partitionable(const csr_graph& graph, int parts) {
  require_valid_graph(graph);
  require_partitionable(graph.node_count(), graph.node_weights, parts);
}

/// Gives every empty part one node: the heaviest one (ties: the first) of the heaviest part with at least two
/// nodes. About n log n.
inline void fill_empty_parts(const csr_graph& graph, std::span<local_id> part, int parts) {
  const auto members = sorted_into_rows<local_id>(static_cast<std::size_t>(parts), [&](const auto& put) {
    for (std::size_t v = 0; v < part.size(); ++v)
      put(part[v], static_cast<local_id>(v));
  });
  std::vector<std::vector<local_id>> left(members.size()); // of donors: what they have, the lightest first
  std::set<std::pair<double, std::size_t>> donors;         // negated weight, part
  const auto weights = part_weights(graph, part, parts);
  for (std::size_t p = 0; p < members.size(); ++p)
    if (members[p].size() > 1)
      donors.insert({-weights[p], p});
  for (std::size_t empty = 0; empty < members.size(); ++empty) {
    if (!members[empty].empty())
      continue;
    const auto [negated_weight, donor] = *donors.begin();
    donors.erase(donors.begin());
    if (left[donor].empty()) {
      append(left[donor], members[donor]);
      sort_all(left[donor], [&](local_id a, local_id b) {
        const auto key = [&](local_id v) {
          return std::pair(graph.node_weights[static_cast<std::size_t>(v)], -v);
        };
        return key(a) < key(b);
      });
    }
    const auto given = static_cast<std::size_t>(left[donor].back());
    left[donor].pop_back();
    part[given] = static_cast<local_id>(empty);
    if (left[donor].size() > 1)
      donors.insert({negated_weight + graph.node_weights[given], donor});
  }
}

} // namespace detail
} // namespace dovetail
