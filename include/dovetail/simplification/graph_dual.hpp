/// @file
/// The dual graphs of a plain graph, for graphs that are those of no mesh.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/graph/concepts.hpp"
#include "dovetail/simplification/dual_graphs.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dovetail {

/// Any weighted graph as an EDG and an SDG at once: its nodes are the elements, its edges the sides, and
/// there are no dihedrals. Edges are numbered as `for_each_edge` meets them from their smaller ends, node
/// after node; each of several parallel edges is a side. A copy of the edges, so the graph may go.
class graph_dual {
public:
  /// `fixed`: not zero for edges that may never be contracted; may be empty. It must outlive the dual.
  template <weighted_graph G>
  explicit graph_dual(const G& graph, std::span<const std::uint8_t> fixed = {}) : fixed_(fixed) {
    for (local_id v = 0; v < static_cast<local_id>(graph.node_count()); ++v) {
      node_weights_.push_back(graph.node_weight(v));
      graph.for_each_edge(v, [&](local_id w, double weight) {
        if (v < w) {
          ends_.push_back({v, w});
          edge_weights_.push_back(weight);
        }
      });
    }
  }

  std::size_t element_count() const { return node_weights_.size(); }
  std::size_t side_count() const { return ends_.size(); }
  double weight(local_id node) const { return node_weights_[node]; }
  std::array<local_id, 2> elements(local_id edge) const { return ends_[edge]; }
  bool is_fixed(local_id edge) const { return !fixed_.empty() && fixed_[edge] != 0; }
  double side_weight(local_id edge) const { return edge_weights_[edge]; }

  std::vector<double> angles() const { return {}; }
  std::array<local_id, 2> sides(dihedral_id) const { return {no_id, no_id}; }
  template <class Visit>
  void for_each_joint(local_id, const Visit&) const {}

private:
  std::vector<double> node_weights_;
  std::vector<std::array<local_id, 2>> ends_;
  std::vector<double> edge_weights_;
  std::span<const std::uint8_t> fixed_;
};
static_assert(element_dual_graph<graph_dual> && side_dual_graph<graph_dual>);

} // namespace dovetail
