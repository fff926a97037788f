/// @file
/// The concepts of Boost.Graph in C++20.
///
/// A type takes part by `enable_graph<G>`: `boost::graph_traits<T>` is a hard error for other types, so the
/// opt-in is tested first and every concept here is safe to ask of any type.
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

/// Boost's Graph: a type that has opted in and names its parts.
///
/// Valid expressions: the types `vertex_descriptor`, `edge_descriptor`, `directed_category`,
/// `edge_parallel_category` and `traversal_category` of `boost::graph_traits<G>`; a vertex descriptor is
/// regular (default constructible, copyable, comparable).
///
/// Semantics: Boost's. The categories say what the graph promises, its other concepts what it can.
///
/// Complexity: descriptors are copied and compared in constant time.
///
/// Failure: none; a descriptor that is not the graph's own is undefined behaviour, as in Boost.
///
/// Models: csr_graph (graph/csr_boost.hpp), element_dual and side_dual (graph/dual.hpp), every
/// `accessible_graph`; boost::adjacency_list and the like, when `enable_graph` is specialised for the type
/// used.
template <class G>
concept graph = enable_graph<std::remove_cv_t<G>> && requires {
  typename boost::graph_traits<G>::vertex_descriptor;
  typename boost::graph_traits<G>::edge_descriptor;
  typename boost::graph_traits<G>::directed_category;
  typename boost::graph_traits<G>::edge_parallel_category;
  typename boost::graph_traits<G>::traversal_category;
} && std::regular<vertex_of<G>>;

/// Boost's IncidenceGraph: the edges out of a vertex.
///
/// Valid expressions for `const G& g`, `vertex_of<G> v`, `edge_of<G> e`:
///
/// - `out_edges(v, g)`: a pair of `out_edge_iterator`
/// - `out_degree(v, g)`: their number, `degree_size_type`
/// - `source(e, g)`, `target(e, g)`: vertex_of<G>
///
/// Semantics: `source(e, g) == v` for every edge in `out_edges(v, g)`. In an undirected graph each edge is
/// met once from either end.
///
/// Complexity: constant; out_degree at most linear in the degree.
///
/// Failure: none; a descriptor that is not the graph's own is undefined behaviour, as in Boost.
///
/// Models: csr_graph (graph/csr_boost.hpp), element_dual and side_dual (graph/dual.hpp), every
/// `accessible_graph`; boost::adjacency_list and the like, when `enable_graph` is specialised for the type
/// used.
template <class G>
concept incidence_graph = graph<G> && requires(const G& g, vertex_of<G> v, edge_of<G> e) {
  typename boost::graph_traits<G>::out_edge_iterator;
  { source(e, g) } -> std::convertible_to<vertex_of<G>>;
  { target(e, g) } -> std::convertible_to<vertex_of<G>>;
  out_edges(v, g).first == out_edges(v, g).second;
  { out_degree(v, g) } -> std::convertible_to<typename boost::graph_traits<G>::degree_size_type>;
};

/// Boost's AdjacencyGraph: the vertices next to a vertex.
///
/// Valid expression for `const G& g`, `vertex_of<G> v`: `adjacent_vertices(v, g)`, a pair of
/// `adjacency_iterator`.
///
/// Semantics: the targets of the edges out of v, in their order.
///
/// Complexity: constant.
///
/// Failure: none; a descriptor that is not the graph's own is undefined behaviour, as in Boost.
///
/// Models: csr_graph (graph/csr_boost.hpp), element_dual and side_dual (graph/dual.hpp), every
/// `accessible_graph`; boost::adjacency_list and the like, when `enable_graph` is specialised for the type
/// used.
template <class G>
concept adjacency_graph = graph<G> && requires(const G& g, vertex_of<G> v) {
  typename boost::graph_traits<G>::adjacency_iterator;
  adjacent_vertices(v, g).first == adjacent_vertices(v, g).second;
};

/// Boost's VertexListGraph: all vertices.
///
/// Valid expressions for `const G& g`:
///
/// - `vertices(g)`: a pair of `vertex_iterator`
/// - `num_vertices(g)`: their number, `vertices_size_type`
///
/// Semantics: every vertex once, in the same order in every walk.
///
/// Complexity: constant.
///
/// Failure: none; a descriptor that is not the graph's own is undefined behaviour, as in Boost.
///
/// Models: csr_graph (graph/csr_boost.hpp), element_dual and side_dual (graph/dual.hpp), every
/// `accessible_graph`; boost::adjacency_list and the like, when `enable_graph` is specialised for the type
/// used.
template <class G>
concept vertex_list_graph = graph<G> && requires(const G& g) {
  typename boost::graph_traits<G>::vertex_iterator;
  vertices(g).first == vertices(g).second;
  { num_vertices(g) } -> std::convertible_to<typename boost::graph_traits<G>::vertices_size_type>;
};

/// Boost's EdgeListGraph: all edges.
///
/// Valid expressions for `const G& g`:
///
/// - `edges(g)`: a pair of `edge_iterator`
/// - `num_edges(g)`: their number, `edges_size_type`
///
/// Semantics: every edge once, in the same order in every walk.
///
/// Complexity: edges(g) constant; num_edges(g) at most linear in the slots of the graph.
///
/// Failure: none; a descriptor that is not the graph's own is undefined behaviour, as in Boost.
///
/// Models: csr_graph (graph/csr_boost.hpp), element_dual and side_dual (graph/dual.hpp), every
/// `accessible_graph`; boost::adjacency_list and the like, when `enable_graph` is specialised for the type
/// used.
template <class G>
concept edge_list_graph = graph<G> && requires(const G& g) {
  typename boost::graph_traits<G>::edge_iterator;
  edges(g).first == edges(g).second;
  { num_edges(g) } -> std::convertible_to<typename boost::graph_traits<G>::edges_size_type>;
};

} // namespace dovetail
