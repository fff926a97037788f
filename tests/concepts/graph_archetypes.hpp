/// @file
/// One archetype per graph concept, each a view of a `csr_graph` with the functions that its concept asks for
/// and no others.
#pragma once

#include "dovetail/graph/csr_boost.hpp"

#include <cstddef>
#include <utility>

namespace dovetail::archetype {

// for graph
/// A graph that can be asked nothing: the base of the others.
struct named_graph {
  using vertex_descriptor = local_id;
  using edge_descriptor = graph_edge;
  using directed_category = boost::undirected_tag;
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
  using traversal_category = boost::no_traversal_tag;

  explicit named_graph(const csr_graph& viewed) : csr(viewed) {}
  named_graph(const named_graph&) = delete;
  named_graph& operator=(const named_graph&) = delete;

  const csr_graph& csr;
};
// end

using csr_traits = boost::graph_traits<csr_graph>;

// for incidence_graph
struct incidence_graph : named_graph {
  using named_graph::named_graph;
  using traversal_category = boost::incidence_graph_tag;
  using out_edge_iterator = csr_traits::out_edge_iterator;
  using degree_size_type = unsigned;

  friend local_id source(graph_edge e, const incidence_graph&) { return e.source; }
  friend local_id target(graph_edge e, const incidence_graph&) { return e.target; }
  friend auto out_edges(local_id v, const incidence_graph& g) { return out_edges(v, g.csr); }
  friend unsigned out_degree(local_id v, const incidence_graph& g) {
    return static_cast<unsigned>(g.csr.row(v).size());
  }
};
// end

// for vertex_list_graph
struct vertex_list_graph : named_graph {
  using named_graph::named_graph;
  using traversal_category = boost::vertex_list_graph_tag;
  using vertex_iterator = csr_traits::vertex_iterator;
  using vertices_size_type = unsigned;

  friend auto vertices(const vertex_list_graph& g) { return vertices(g.csr); }
  friend unsigned num_vertices(const vertex_list_graph& g) {
    return static_cast<unsigned>(g.csr.offsets.size() - 1);
  }
};
// end

// for adjacency_graph
struct adjacency_graph : named_graph {
  using named_graph::named_graph;
  using traversal_category = boost::adjacency_graph_tag;
  using adjacency_iterator = csr_traits::adjacency_iterator;

  friend auto adjacent_vertices(local_id v, const adjacency_graph& g) { return adjacent_vertices(v, g.csr); }
};
// end

// for edge_list_graph
struct edge_list_graph : named_graph {
  using named_graph::named_graph;
  using traversal_category = boost::edge_list_graph_tag;
  using edge_iterator = csr_traits::edge_iterator;
  using edges_size_type = unsigned;

  friend auto edges(const edge_list_graph& g) { return edges(g.csr); }
  friend unsigned num_edges(const edge_list_graph& g) {
    return static_cast<unsigned>(g.csr.neighbours.size() / 2);
  }
};
// end

/// Two concepts at once: what a breadth-first walk asks for.
struct walkable_graph : vertex_list_graph {
  using vertex_list_graph::vertex_list_graph;
  struct traversal_category : boost::vertex_list_graph_tag, boost::adjacency_graph_tag {};
  using adjacency_iterator = csr_traits::adjacency_iterator;

  friend auto adjacent_vertices(local_id v, const walkable_graph& g) { return adjacent_vertices(v, g.csr); }
};

// for accessible_graph
/// A graph that is read by the specialisation of `graph_access` below, and by nothing else.
class accessible_graph : graph_functions {
public:
  explicit accessible_graph(const csr_graph& viewed) : csr_(viewed) {}
  accessible_graph(const accessible_graph&) = delete;
  accessible_graph& operator=(const accessible_graph&) = delete;

private:
  friend graph_access<accessible_graph>;
  const csr_graph& csr_;
};
// end

} // namespace dovetail::archetype

namespace dovetail {

// for accessible_graph
template <>
struct graph_access<archetype::accessible_graph> {
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
  using csr = graph_access<csr_graph>;

  static std::size_t vertex_count(const archetype::accessible_graph& g) { return csr::vertex_count(g.csr_); }
  static std::size_t row_slots(const archetype::accessible_graph& g, local_id v) {
    return csr::row_slots(g.csr_, v);
  }
  static bool row_edge(const archetype::accessible_graph& g, local_id v, std::size_t slot, graph_edge& e) {
    return csr::row_edge(g.csr_, v, slot, e);
  }
  static std::size_t edge_slots(const archetype::accessible_graph& g) { return csr::edge_slots(g.csr_); }
  static bool list_edge(const archetype::accessible_graph& g, std::size_t slot, graph_edge& e) {
    return csr::list_edge(g.csr_, slot, e);
  }
};
// end

template <>
inline constexpr bool enable_graph<archetype::named_graph> = true;
template <>
inline constexpr bool enable_graph<archetype::incidence_graph> = true;
template <>
inline constexpr bool enable_graph<archetype::vertex_list_graph> = true;
template <>
inline constexpr bool enable_graph<archetype::adjacency_graph> = true;
template <>
inline constexpr bool enable_graph<archetype::edge_list_graph> = true;
template <>
inline constexpr bool enable_graph<archetype::walkable_graph> = true;

} // namespace dovetail
