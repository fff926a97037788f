/// @file
/// Graphs of Boost.Graph for the algorithms of this library, and graphs of this library for Boost's. The only
/// header that includes Boost.Graph; its target is dovetail::boost_graph.
#pragma once

#include "dovetail/graph/concepts.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/graph_traits.hpp>
#include <boost/graph/properties.hpp>

#include <cstddef>
#include <span>
#include <type_traits>

namespace dovetail {

/// A view of an undirected Boost graph (IncidenceGraph and VertexListGraph) whose vertices are whole numbers,
/// such as `adjacency_list<vecS, vecS, undirectedS>`. Edges weigh what their property `edge_weight_t` says,
/// or 1. What it is given must outlive it.
template <class BoostGraph>
  requires std::is_integral_v<typename boost::graph_traits<BoostGraph>::vertex_descriptor> &&
      std::is_convertible_v<typename boost::graph_traits<BoostGraph>::directed_category,
                            boost::undirected_tag>
class boost_view {
public:
  /// `node_weights`: one per vertex, or empty for 1 each.
  explicit boost_view(const BoostGraph& viewed, std::span<const double> node_weights = {})
      : graph_(&viewed), node_weights_(node_weights) {}
  explicit boost_view(const BoostGraph&&, std::span<const double> = {}) = delete; // it would be gone

  std::size_t node_count() const { return num_vertices(*graph_); }
  double node_weight(local_id node) const {
    return node_weights_.empty() ? 1.0 : node_weights_[static_cast<std::size_t>(node)];
  }
  template <class Visit>
  void for_each_neighbour(local_id node, const Visit& visit) const {
    for_each_edge(node, [&](local_id other, double) { visit(other); });
  }
  template <class Visit>
  void for_each_edge(local_id node, const Visit& visit) const {
    for (auto [edge, end] = out_edges(static_cast<vertex>(node), *graph_); edge != end; ++edge)
      if constexpr (has_weights)
        visit(static_cast<local_id>(target(*edge, *graph_)),
              static_cast<double>(get(boost::edge_weight, *graph_, *edge)));
      else
        visit(static_cast<local_id>(target(*edge, *graph_)), 1.0);
  }

private:
  using vertex = typename boost::graph_traits<BoostGraph>::vertex_descriptor;
  static constexpr bool has_weights =
      boost::lookup_one_property<typename boost::edge_property_type<BoostGraph>::type,
                                 boost::edge_weight_t>::found;

  const BoostGraph* graph_;
  std::span<const double> node_weights_;
};

/// The type of `to_boost`.
using weighted_adjacency_list =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                          boost::property<boost::edge_weight_t, double>>;

/// A copy of a graph for Boost's algorithms, with the numbers of its nodes and, if it has any, the weights of
/// its edges. Linear.
template <graph G>
weighted_adjacency_list to_boost(const G& graph) {
  weighted_adjacency_list copy(static_cast<std::size_t>(graph.node_count()));
  const auto add = [&copy](local_id v, local_id w, double weight) {
    if (v < w)
      boost::add_edge(static_cast<std::size_t>(v), static_cast<std::size_t>(w), weight, copy);
  };
  for (local_id v = 0; v < static_cast<local_id>(graph.node_count()); ++v)
    if constexpr (weighted_graph<G>)
      graph.for_each_edge(v, [&](local_id w, double weight) { add(v, w, weight); });
    else
      graph.for_each_neighbour(v, [&](local_id w) { add(v, w, 1.0); });
  return copy;
}

} // namespace dovetail
