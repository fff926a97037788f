/// @file
/// What the graph algorithms ask of a graph. Graphs are undirected; nodes are numbered 0, 1, 2, ...
#pragma once

#include "dovetail/core/ids.hpp"

#include <concepts>
#include <cstddef>

namespace dovetail {

/// Nodes and their neighbours: enough for walks and components.
///
/// Valid expressions for `const G& g`, `local_id v`, `visit` callable with a `local_id`:
///
/// - `g.node_count()`: an integer
/// - `g.for_each_neighbour(v, visit)`: calls `visit(w)` for the other end w of every edge at v
///
/// Semantics: an edge is visited once from each of its ends, always in the same order, also a parallel one.
/// There are no self loops.
///
/// Complexity: constant, and linear in the edges at v.
///
/// Failure: none; a node out of range is undefined behaviour.
///
/// Models: every weighted_graph.
template <class G>
concept graph = requires(const G& g, local_id v, void (&visit)(local_id)) {
  { g.node_count() } -> std::convertible_to<std::size_t>;
  g.for_each_neighbour(v, visit);
};

/// A graph with weights: enough to partition, contract and divide it. It converts to a `csr_graph`, which
/// partitioners work on.
///
/// Valid expressions, beside those of `graph`, for `const G& g`, `local_id v`, `visit` callable with a
/// `local_id` and a `double`:
///
/// - `g.node_weight(v)`: double
/// - `g.for_each_edge(v, visit)`: calls `visit(w, weight)` for every edge at v
///
/// Semantics: the edges of `for_each_neighbour` in the same order; an edge weighs the same from both ends.
///
/// Complexity: constant, and linear in the edges at v.
///
/// Failure: none; a node out of range is undefined behaviour.
///
/// Models: csr_graph, element_dual, boost_view.
template <class G>
concept weighted_graph = graph<G> && requires(const G& g, local_id v, void (&visit)(local_id, double)) {
  { g.node_weight(v) } -> std::convertible_to<double>;
  g.for_each_edge(v, visit);
};

} // namespace dovetail
