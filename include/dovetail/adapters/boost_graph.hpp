/// @file
/// Graphs of Boost.Graph for the algorithms of this library, and graphs of this library for Boost's. The only
/// header that includes Boost.Graph; its target is dovetail::boost_graph.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/graph/concepts.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/graph_traits.hpp>
#include <boost/graph/properties.hpp>
#include <boost/property_map/property_map.hpp>

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

/// Whether every edge of a Boost graph is met from both of its ends: undirected graphs. Specialise it for a
/// type of directed graphs that have every edge in both directions, such as `boost::grid_graph`.
template <class BoostGraph>
inline constexpr bool is_symmetric_boost_graph =
    std::is_convertible_v<typename boost::graph_traits<BoostGraph>::directed_category, boost::undirected_tag>;

/// The weights of edges in a Boost graph that has none inside: 1 each.
struct equal_edge_weights {
  template <class Edge>
  friend double get(const equal_edge_weights&, const Edge&) {
    return 1;
  }
};

namespace detail {

/// The weights that a Boost graph has inside, as `edge_weight_t`, or 1 each.
template <class BoostGraph>
auto inner_edge_weights(const BoostGraph& graph) {
  if constexpr (requires { typename BoostGraph::edge_property_type; }) {
    using properties = typename BoostGraph::edge_property_type;
    if constexpr (boost::lookup_one_property<properties, boost::edge_weight_t>::found)
      return get(boost::edge_weight, graph);
    else
      return equal_edge_weights{};
  } else {
    return equal_edge_weights{};
  }
}

template <class Weights, class BoostGraph>
inline constexpr bool are_edge_weights =
    requires(const Weights& weights, typename boost::graph_traits<BoostGraph>::edge_descriptor edge) {
  { get(weights, edge) } -> std::convertible_to<double>;
};

} // namespace detail

/// A view of a symmetric Boost graph as a `weighted_graph`. The Boost graph is an IncidenceGraph and
/// VertexListGraph whose vertices have the numbers 0, 1, 2, ... as `vertex_index`; self loops are passed
/// over. Edges weigh what a property map says: the one given, such as `get(&road::lanes, graph)`, or the
/// graph's own `edge_weight_t`, or else 1. What the view is given must outlive it.
template <class BoostGraph,
          class EdgeWeights = decltype(detail::inner_edge_weights(std::declval<const BoostGraph&>()))>
  requires is_symmetric_boost_graph<BoostGraph> && detail::are_edge_weights<EdgeWeights, BoostGraph>
class boost_view {
public:
  /// Of the nodes, one each, for partitioners that go by place; or empty.
  std::span<const vec3> positions;

  /// `node_weights`: one per vertex, or empty for 1 each.
  explicit boost_view(const BoostGraph& viewed, std::span<const double> node_weights = {},
                      std::span<const vec3> node_positions = {})
      : boost_view(viewed, detail::inner_edge_weights(viewed), node_weights, node_positions) {}
  boost_view(const BoostGraph& viewed, EdgeWeights edge_weights, std::span<const double> node_weights = {},
             std::span<const vec3> node_positions = {})
      : positions(node_positions), graph_(&viewed), edge_weights_(std::move(edge_weights)),
        node_weights_(node_weights) {
    if constexpr (!is_numbered) {
      vertices_.resize(num_vertices(viewed));
      const auto number = get(boost::vertex_index, viewed);
      for (auto [v, end] = vertices(viewed); v != end; ++v)
        vertices_[get(number, *v)] = *v;
    }
  }
  template <class... Given>
  explicit boost_view(const BoostGraph&&, const Given&...) = delete; // it would be gone

  std::size_t node_count() const { return num_vertices(*graph_); }
  double node_weight(local_id node) const { return node_weights_.empty() ? 1.0 : node_weights_[node]; }
  template <class Visit>
  void for_each_neighbour(local_id node, const Visit& visit) const {
    visit_edges(node, [&](local_id other, const auto&) { visit(other); });
  }
  template <class Visit>
  void for_each_edge(local_id node, const Visit& visit) const {
    visit_edges(node, [&](local_id other, const auto& edge) {
      visit(other, static_cast<double>(get(edge_weights_, edge)));
    });
  }

private:
  using vertex = typename boost::graph_traits<BoostGraph>::vertex_descriptor;
  static constexpr bool is_numbered = std::is_integral_v<vertex>;

  vertex vertex_of(local_id node) const {
    if constexpr (is_numbered)
      return static_cast<vertex>(node);
    else
      return vertices_[node];
  }
  template <class Visit>
  void visit_edges(local_id node, const Visit& visit) const {
    const auto number = get(boost::vertex_index, *graph_);
    for (auto [edge, end] = out_edges(vertex_of(node), *graph_); edge != end; ++edge)
      if (const auto other = static_cast<local_id>(get(number, target(*edge, *graph_))); other != node)
        visit(other, *edge);
  }

  const BoostGraph* graph_;
  EdgeWeights edge_weights_;
  std::span<const double> node_weights_;
  std::vector<vertex> vertices_; ///< by number, where they are no numbers themselves
};

/// The type of `to_boost`.
using weighted_adjacency_list =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                          boost::property<boost::edge_weight_t, double>>;

/// A copy of a graph for Boost's algorithms, with the numbers of its nodes and, if it has any, the weights of
/// its edges. Linear.
/// Throws nothing of its own.
/// \param graph any graph, with node positions or without
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
