/// @file
/// An undirected weighted graph in compressed rows: what partitioners work on, and what every weighted graph
/// converts to.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/graph/concepts.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// The positions of a graph's nodes, where it has any.
template <graph G>
std::span<const vec3> positions_of(const G& graph) {
  if constexpr (requires { graph.positions.data(); })
    return {graph.positions.data(), graph.positions.size()};
  else
    return {};
}

/// Every edge is stored twice, once in the row of each end. No self loops, no parallel edges.
struct csr_graph {
  std::vector<std::int64_t> offsets{0}; ///< size nodes + 1
  std::vector<local_id> neighbours;     ///< size 2 x edges
  std::vector<double> edge_weights;     ///< parallel to `neighbours`
  std::vector<double> node_weights;     ///< size nodes
  std::vector<vec3> positions = {};     ///< size nodes, for partitioners that go by place; or empty

  using fields = field_list<&csr_graph::offsets, &csr_graph::neighbours, &csr_graph::edge_weights,
                            &csr_graph::node_weights, &csr_graph::positions>;
  csr_graph() = default;
  /// A copy of any weighted graph: parallel edges are merged (weights added), self loops dropped, rows
  /// sorted. It converts, so that whatever takes a `const csr_graph&`, such as a partitioner, takes every
  /// weighted graph, and a `csr_graph` itself without a copy. Linear but for sorting the rows.
  template <class G>
    requires(!std::same_as<G, csr_graph>)
  &&weighted_graph<G> csr_graph(const G& graph); // NOLINT: converts

  local_id node_count() const { return static_cast<local_id>(offsets.size() - 1); }
  /// The neighbours of a node, ascending.
  std::span<const local_id> row(local_id node) const {
    const auto begin = static_cast<std::size_t>(offsets[node]);
    const auto end = static_cast<std::size_t>(offsets[static_cast<std::size_t>(node) + 1]);
    return span_of(neighbours).subspan(begin, end - begin);
  }

  template <class Visit>
  void for_each_neighbour(local_id node, const Visit& visit) const {
    for (const local_id other : row(node))
      visit(other);
  }
  double node_weight(local_id node) const { return node_weights[node]; }
  template <class Visit>
  void for_each_edge(local_id node, const Visit& visit) const {
    const auto end = offsets[static_cast<std::size_t>(node) + 1];
    for (auto k = offsets[node]; k < end; ++k)
      visit(neighbours[k], edge_weights[k]);
  }
};
static_assert(weighted_graph<csr_graph>);

template <class G>
  requires(!std::same_as<G, csr_graph>)
&&weighted_graph<G> csr_graph::csr_graph(const G& graph) {
  const auto nodes = static_cast<local_id>(graph.node_count());
  offsets.reserve(static_cast<std::size_t>(nodes) + 1);
  node_weights.reserve(static_cast<std::size_t>(nodes));
  std::vector<std::pair<local_id, double>> row;
  for (local_id v = 0; v < nodes; ++v) {
    row.clear();
    graph.for_each_edge(v, [&](local_id other, double weight) {
      if (other != v)
        row.emplace_back(other, weight);
    });
    sort_all(row); // by weight too, so that both ends add parallel edges up in the same order
    const std::size_t begin = neighbours.size();
    for (const auto& [other, weight] : row)
      if (neighbours.size() > begin && neighbours.back() == other) {
        edge_weights.back() += weight;
      } else {
        neighbours.push_back(other);
        edge_weights.push_back(weight);
      }
    offsets.push_back(static_cast<std::int64_t>(neighbours.size()));
    node_weights.push_back(graph.node_weight(v));
  }
  const auto known = positions_of(graph);
  positions.assign(known.begin(), known.end());
}

} // namespace dovetail
