/// @file
/// csr_graph as a model of Boost.Graph, with its weights as property maps.
///
/// `graph_edge::index` is the place of the edge in the row of its smaller end, so it is the same from both
/// ends.
#pragma once

#include "dovetail/graph/boost_adaptor.hpp"
#include "dovetail/graph/csr_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace dovetail {

template <>
struct graph_access<csr_graph> {
  using edge_parallel_category = boost::disallow_parallel_edge_tag;

  static std::size_t vertex_count(const csr_graph& g) { return g.offsets.size() - 1; }
  static std::size_t row_slots(const csr_graph& g, local_id v) { return g.row(v).size(); }
  static bool row_edge(const csr_graph& g, local_id v, std::size_t slot, graph_edge& e) {
    const std::size_t begin = static_cast<std::size_t>(g.offsets[static_cast<std::size_t>(v)]);
    const local_id other = g.neighbours[begin + slot];
    e = {v, other, v < other ? static_cast<std::int64_t>(begin + slot) : index_of(g, other, v)};
    return true;
  }
  static std::span<const local_id> row_neighbours(const csr_graph& g, local_id v) { return g.row(v); }
  static std::size_t edge_slots(const csr_graph& g) { return g.neighbours.size(); }
  static bool list_edge(const csr_graph& g, std::size_t slot, graph_edge& e) {
    const auto row = std::upper_bound(g.offsets.begin(), g.offsets.end(), static_cast<std::int64_t>(slot));
    e = {static_cast<local_id>(row - g.offsets.begin() - 1), g.neighbours[slot],
         static_cast<std::int64_t>(slot)};
    return e.source < e.target;
  }

private:
  /// Rows are sorted (see `make_csr_graph`), so the twin is found by bisection.
  static std::int64_t index_of(const csr_graph& g, local_id v, local_id other) {
    const auto row = g.row(v);
    return g.offsets[static_cast<std::size_t>(v)] +
           (std::lower_bound(row.begin(), row.end(), other) - row.begin());
  }
};

namespace detail {

/// Reads the weight of an edge of a csr_graph.
struct csr_weight_map {
  using value_type = double;
  using reference = double;
  using key_type = graph_edge;
  using category = boost::readable_property_map_tag;
  const csr_graph* graph = nullptr;

  friend double get(const csr_weight_map& map, const graph_edge& e) {
    return map.graph->edge_weights[static_cast<std::size_t>(e.index)];
  }
};

} // namespace detail

inline detail::csr_weight_map get(boost::edge_weight_t /*tag*/, const csr_graph& g) {
  return {&g};
}
inline double get(boost::edge_weight_t /*tag*/, const csr_graph& g, const graph_edge& e) {
  return g.edge_weights[static_cast<std::size_t>(e.index)];
}

} // namespace dovetail

namespace boost {

template <>
struct property_map<dovetail::csr_graph, edge_weight_t> {
  using type = dovetail::detail::csr_weight_map;
  using const_type = type;
};

} // namespace boost
