/// @file
/// Makes a Boost graph out of any type that can enumerate its rows.
///
/// A graph type G takes part by specialising `graph_access<G>`. From that follow `boost::graph_traits<G>`,
/// the property maps `vertex_index` and `edge_index`, and the free functions of Boost's IncidenceGraph,
/// AdjacencyGraph, VertexListGraph and EdgeListGraph, found by argument-dependent lookup. The graphs are
/// undirected and read-only views: every edge is met once from each end, and once in the edge list.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/graph/concepts.hpp"

#include <boost/graph/properties.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>

namespace dovetail {

/// An edge as met from one end. `index` is the same from both ends, and two edges are equal when it is.
struct graph_edge {
  local_id source = no_id;
  local_id target = no_id;
  std::int64_t index = -1;

  friend constexpr bool operator==(const graph_edge& a, const graph_edge& b) { return a.index == b.index; }
};

/// Base for graphs of another namespace, so that argument-dependent lookup finds the functions of this file.
struct graph_functions {};

/// Specialise with the static members that `accessible_graph` asks for.
template <class G>
struct graph_access;

/// A graph whose rows can be read by index: a specialisation of `graph_access<G>` makes it a model of the
/// other graph concepts and of Boost's own. A type outside namespace dovetail derives from `graph_functions`.
///
/// Valid expressions for `const G& g`, `local_id v`, `std::size_t k`, `graph_edge& e`, `A = graph_access<G>`:
///
/// - `A::vertex_count(g)`: the number of vertices, 0, 1, 2, ...
/// - `A::row_slots(g, v)`: the number of *slots*, places where an edge may be, of the row of v
/// - `A::row_edge(g, v, k, e)`: sets e to the edge in slot k; false for an empty slot, which is skipped
/// - `A::edge_slots(g)`, `A::list_edge(g, k, e)`: the same for the list of all edges
/// - `A::edge_parallel_category`: of Boost
/// - `A::row_neighbours(g, v)`: optional, the neighbours of v as a contiguous range of `local_id`, in the
/// order of the slots, where they lie in an array
///
/// Semantics: an edge out of v has source v; it has the same index in the rows of both its ends and in the
/// list, where it comes once.
///
/// Complexity: constant.
///
/// Failure: none; an index out of range is undefined behaviour.
///
/// Models: csr_graph, element_dual, side_dual.
template <class G>
concept accessible_graph = requires(const G& g, local_id v, std::size_t k, graph_edge& e) {
  typename graph_access<G>::edge_parallel_category;
  { graph_access<G>::vertex_count(g) } -> std::convertible_to<std::size_t>;
  { graph_access<G>::row_slots(g, v) } -> std::convertible_to<std::size_t>;
  { graph_access<G>::row_edge(g, v, k, e) } -> std::convertible_to<bool>;
  { graph_access<G>::edge_slots(g) } -> std::convertible_to<std::size_t>;
  { graph_access<G>::list_edge(g, k, e) } -> std::convertible_to<bool>;
};

template <accessible_graph G>
inline constexpr bool enable_graph<G> = true;

namespace detail {

/// Iterates over the filled slots of a row, yielding edges.
template <class G>
struct row_slots {
  using value_type = graph_edge;
  const G* graph = nullptr;
  local_id vertex = no_id;

  std::size_t size() const { return graph_access<G>::row_slots(*graph, vertex); }
  bool read(std::size_t slot, value_type& e) const {
    return graph_access<G>::row_edge(*graph, vertex, slot, e);
  }
};

/// Iterates over the filled slots of a row, yielding the vertices at the other end.
template <class G>
struct neighbour_slots {
  using value_type = local_id;
  const G* graph = nullptr;
  local_id vertex = no_id;

  std::size_t size() const { return graph_access<G>::row_slots(*graph, vertex); }
  bool read(std::size_t slot, value_type& v) const {
    graph_edge e;
    const bool filled = graph_access<G>::row_edge(*graph, vertex, slot, e);
    v = e.target;
    return filled;
  }
};

/// Iterates over the filled slots of the edge list.
template <class G>
struct list_slots {
  using value_type = graph_edge;
  const G* graph = nullptr;

  std::size_t size() const { return graph_access<G>::edge_slots(*graph); }
  bool read(std::size_t slot, value_type& e) const { return graph_access<G>::list_edge(*graph, slot, e); }
};

/// All vertices.
struct vertex_slots {
  using value_type = local_id;
  std::size_t count = 0;

  std::size_t size() const { return count; }
  bool read(std::size_t slot, value_type& v) const {
    v = static_cast<local_id>(slot);
    return true;
  }
};

/// A multi-pass iterator over the filled slots of `Slots`, yielding by value.
template <class Slots>
class slot_iterator {
public:
  using value_type = typename Slots::value_type;
  using reference = value_type;
  using pointer = const value_type*;
  using difference_type = std::ptrdiff_t;
  using iterator_category = std::forward_iterator_tag;

  slot_iterator() = default;
  /// The range of all filled slots.
  static std::pair<slot_iterator, slot_iterator> range_of(Slots slots) {
    const std::size_t size = slots.size();
    slot_iterator first(slots, 0, size);
    first.settle();
    return {first, slot_iterator(slots, size, size)};
  }

  value_type operator*() const { return value_; }
  const value_type* operator->() const { return &value_; }
  slot_iterator& operator++() {
    ++slot_;
    settle();
    return *this;
  }
  slot_iterator operator++(int) {
    slot_iterator old = *this;
    ++*this;
    return old;
  }
  friend bool operator==(const slot_iterator& a, const slot_iterator& b) { return a.slot_ == b.slot_; }

private:
  slot_iterator(Slots slots, std::size_t slot, std::size_t size) : slots_(slots), slot_(slot), size_(size) {}

  /// Ends at the very `size_` that the past-the-end iterator holds: a compiler that sees both then makes one
  /// flat loop of this one and the user's.
  void settle() {
    while (slot_ != size_ && !slots_.read(slot_, value_))
      ++slot_;
  }

  Slots slots_{};
  std::size_t slot_ = 0;
  std::size_t size_ = 0;
  value_type value_{};
};

template <class Slots>
std::pair<slot_iterator<Slots>, slot_iterator<Slots>> slot_range(Slots slots) {
  return slot_iterator<Slots>::range_of(slots);
}

/// The neighbours of a row lie in an array.
template <class G>
inline constexpr bool has_neighbour_array = requires(const G& g, local_id v) {
  graph_access<G>::row_neighbours(g, v);
};

template <class G>
using neighbour_iterator =
    std::conditional_t<has_neighbour_array<G>, const local_id*, slot_iterator<neighbour_slots<G>>>;

struct view_traversal_tag : boost::incidence_graph_tag,
                            boost::adjacency_graph_tag,
                            boost::vertex_list_graph_tag,
                            boost::edge_list_graph_tag {};

/// Reads `graph_edge::index`.
struct edge_index_map {
  using value_type = std::int64_t;
  using reference = std::int64_t;
  using key_type = graph_edge;
  using category = boost::readable_property_map_tag;

  friend std::int64_t get(edge_index_map /*map*/, const graph_edge& e) { return e.index; }
};

} // namespace detail

template <accessible_graph G>
local_id source(const graph_edge& e, const G& /*graph*/) {
  return e.source;
}
template <accessible_graph G>
local_id target(const graph_edge& e, const G& /*graph*/) {
  return e.target;
}
template <accessible_graph G>
auto out_edges(local_id vertex, const G& g) {
  return detail::slot_range(detail::row_slots<G>{&g, vertex});
}
template <accessible_graph G>
std::pair<detail::neighbour_iterator<G>, detail::neighbour_iterator<G>> adjacent_vertices(local_id vertex,
                                                                                          const G& g) {
  if constexpr (detail::has_neighbour_array<G>) {
    const std::span<const local_id> row = graph_access<G>::row_neighbours(g, vertex);
    return {row.data(), row.data() + row.size()};
  } else {
    return detail::slot_range(detail::neighbour_slots<G>{&g, vertex});
  }
}
template <accessible_graph G>
auto vertices(const G& g) {
  return detail::slot_range(detail::vertex_slots{graph_access<G>::vertex_count(g)});
}
template <accessible_graph G>
auto edges(const G& g) {
  return detail::slot_range(detail::list_slots<G>{&g});
}
template <accessible_graph G>
std::size_t num_vertices(const G& g) {
  return graph_access<G>::vertex_count(g);
}
/// Complexity: the number of edges.
template <accessible_graph G>
std::size_t num_edges(const G& g) {
  const auto [first, last] = edges(g);
  return static_cast<std::size_t>(std::distance(first, last));
}
template <accessible_graph G>
std::size_t out_degree(local_id vertex, const G& g) {
  const auto [first, last] = out_edges(vertex, g);
  return static_cast<std::size_t>(std::distance(first, last));
}
template <accessible_graph G>
boost::typed_identity_property_map<local_id> get(boost::vertex_index_t /*tag*/, const G& /*graph*/) {
  return {};
}
template <accessible_graph G>
local_id get(boost::vertex_index_t /*tag*/, const G& /*graph*/, local_id vertex) {
  return vertex;
}
template <accessible_graph G>
detail::edge_index_map get(boost::edge_index_t /*tag*/, const G& /*graph*/) {
  return {};
}
template <accessible_graph G>
std::int64_t get(boost::edge_index_t /*tag*/, const G& /*graph*/, const graph_edge& e) {
  return e.index;
}

} // namespace dovetail

namespace boost {

template <dovetail::accessible_graph G>
struct graph_traits<G> {
  using vertex_descriptor = dovetail::local_id;
  using edge_descriptor = dovetail::graph_edge;
  using directed_category = undirected_tag;
  using edge_parallel_category = typename dovetail::graph_access<G>::edge_parallel_category;
  using traversal_category = dovetail::detail::view_traversal_tag;
  using vertices_size_type = std::size_t;
  using edges_size_type = std::size_t;
  using degree_size_type = std::size_t;
  using out_edge_iterator = dovetail::detail::slot_iterator<dovetail::detail::row_slots<G>>;
  using adjacency_iterator = dovetail::detail::neighbour_iterator<G>;
  using vertex_iterator = dovetail::detail::slot_iterator<dovetail::detail::vertex_slots>;
  using edge_iterator = dovetail::detail::slot_iterator<dovetail::detail::list_slots<G>>;
  static vertex_descriptor null_vertex() { return dovetail::no_id; }
};

template <dovetail::accessible_graph G>
struct property_map<G, vertex_index_t> {
  using type = typed_identity_property_map<dovetail::local_id>;
  using const_type = type;
};
template <dovetail::accessible_graph G>
struct property_map<G, edge_index_t> {
  using type = dovetail::detail::edge_index_map;
  using const_type = type;
};

} // namespace boost
