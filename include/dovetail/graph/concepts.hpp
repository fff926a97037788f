/// @file
/// The concepts of Boost.Graph in C++20.
///
/// A type takes part by `enable_graph<G>`: `boost::graph_traits<T>` is a hard error for other types, so the
/// opt-in is tested first and every concept here is safe to ask of any type. Models: boost::adjacency_list
/// and the like (specialise `enable_graph` for the type used), csr_graph (graph/csr_boost.hpp), element_dual
/// and side_dual (graph/dual.hpp). Valid expressions and complexity are those of Boost's documentation for
/// the concept of the same name.
#pragma once

#include <boost/graph/graph_traits.hpp>

#include <concepts>
#include <type_traits>
#include <utility>

namespace dovetail {

/// Specialise to true for a type that models Boost.Graph concepts.
template <class G>
inline constexpr bool enable_graph = false;

template <class G>
using vertex_of = typename boost::graph_traits<G>::vertex_descriptor;
template <class G>
using edge_of = typename boost::graph_traits<G>::edge_descriptor;

/// Boost's Graph: the associated types exist.
template <class G>
concept graph = enable_graph<std::remove_cv_t<G>> && requires {
  typename boost::graph_traits<G>::vertex_descriptor;
  typename boost::graph_traits<G>::edge_descriptor;
  typename boost::graph_traits<G>::directed_category;
  typename boost::graph_traits<G>::edge_parallel_category;
  typename boost::graph_traits<G>::traversal_category;
} && std::regular<vertex_of<G>>;

/// Boost's IncidenceGraph: the edges out of a vertex.
template <class G>
concept incidence_graph = graph<G> && requires(const G& g, vertex_of<G> v, edge_of<G> e) {
  typename boost::graph_traits<G>::out_edge_iterator;
  { source(e, g) } -> std::convertible_to<vertex_of<G>>;
  { target(e, g) } -> std::convertible_to<vertex_of<G>>;
  out_edges(v, g).first == out_edges(v, g).second;
  { out_degree(v, g) } -> std::convertible_to<typename boost::graph_traits<G>::degree_size_type>;
};

/// Boost's AdjacencyGraph: the vertices next to a vertex.
template <class G>
concept adjacency_graph = graph<G> && requires(const G& g, vertex_of<G> v) {
  typename boost::graph_traits<G>::adjacency_iterator;
  adjacent_vertices(v, g).first == adjacent_vertices(v, g).second;
};

/// Boost's VertexListGraph: all vertices.
template <class G>
concept vertex_list_graph = graph<G> && requires(const G& g) {
  typename boost::graph_traits<G>::vertex_iterator;
  vertices(g).first == vertices(g).second;
  { num_vertices(g) } -> std::convertible_to<typename boost::graph_traits<G>::vertices_size_type>;
};

/// Boost's EdgeListGraph: all edges.
template <class G>
concept edge_list_graph = graph<G> && requires(const G& g) {
  typename boost::graph_traits<G>::edge_iterator;
  edges(g).first == edges(g).second;
  { num_edges(g) } -> std::convertible_to<typename boost::graph_traits<G>::edges_size_type>;
};

} // namespace dovetail
