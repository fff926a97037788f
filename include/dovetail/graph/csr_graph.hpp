/// @file
/// An undirected weighted graph in compressed rows, as partitioners take it.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/graph/concepts.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace dovetail {

/// Every edge is stored twice, once in the row of each end. No self loops, no parallel edges.
struct csr_graph {
  std::vector<std::int64_t> offsets{0}; ///< size nodes + 1
  std::vector<local_id> neighbours;     ///< size 2 x edges
  std::vector<double> edge_weights;     ///< parallel to `neighbours`
  std::vector<double> node_weights;     ///< size nodes
  std::vector<vec3> positions = {};     ///< size nodes, for partitioners that go by place; or empty

  static constexpr auto fields =
      std::tuple(&csr_graph::offsets, &csr_graph::neighbours, &csr_graph::edge_weights,
                 &csr_graph::node_weights, &csr_graph::positions);

  local_id node_count() const { return static_cast<local_id>(offsets.size() - 1); }
  std::span<const local_id> row(local_id node) const {
    const auto begin = static_cast<std::size_t>(offsets[static_cast<std::size_t>(node)]);
    const auto end = static_cast<std::size_t>(offsets[static_cast<std::size_t>(node) + 1]);
    return span_of(neighbours).subspan(begin, end - begin);
  }

  template <class Visit>
  void for_each_neighbour(local_id node, const Visit& visit) const {
    for (const local_id other : row(node))
      visit(other);
  }
  double node_weight(local_id node) const { return node_weights[static_cast<std::size_t>(node)]; }
  template <class Visit>
  void for_each_edge(local_id node, const Visit& visit) const {
    const auto end = offsets[static_cast<std::size_t>(node) + 1];
    for (auto k = offsets[static_cast<std::size_t>(node)]; k < end; ++k)
      visit(neighbours[static_cast<std::size_t>(k)], edge_weights[static_cast<std::size_t>(k)]);
  }
};
static_assert(weighted_graph<csr_graph>);

} // namespace dovetail
