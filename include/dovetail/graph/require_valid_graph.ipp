/// @file
/// What `require_valid_graph.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/scattered.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/graph/require_valid_graph.hpp"
#include "dovetail/mesh/chain_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

[[noreturn]] inline void refuse_graph(const std::string& why) {
  throw partition_error("the graph: " + why);
}

inline void require_rows(const csr_graph& graph) {
  const auto one_each = [](std::size_t given, const char* what, std::size_t wanted, const char* of) {
    if (given != wanted)
      refuse_graph(std::to_string(given) + " " + what + " for " + std::to_string(wanted) + " " + of +
                   "; give one each");
  };
  const std::size_t nodes = graph.node_weights.size();
  if (graph.offsets.size() != nodes + 1)
    refuse_graph(std::to_string(graph.offsets.size()) + " offsets for " + std::to_string(nodes) +
                 " node weights; give one offset more than there are nodes");
  if (graph.offsets.front() != 0 ||
      graph.offsets.back() != static_cast<std::int64_t>(graph.neighbours.size()))
    refuse_graph("its rows are from " + std::to_string(graph.offsets.front()) + " to " +
                 std::to_string(graph.offsets.back()) + " of " + std::to_string(graph.neighbours.size()) +
                 " neighbours; offsets begin with 0 and end with their number");
  for (std::size_t v = 0; v < nodes; ++v)
    if (graph.offsets[v] > graph.offsets[v + 1])
      refuse_graph("the row of node " + std::to_string(v) + " is from " + std::to_string(graph.offsets[v]) +
                   " to " + std::to_string(graph.offsets[v + 1]) + "; offsets must not fall");
  one_each(graph.edge_weights.size(), "edge weights", graph.neighbours.size(), "neighbours");
  if (!graph.positions.empty())
    one_each(graph.positions.size(), "positions", nodes, "nodes");
}

/// Calls `visit(node, neighbour, weight)` for each entry of each row.
template <class Visit>
void for_each_arc(const csr_graph& graph, const Visit& visit) {
  for (std::size_t v = 0; v < graph.node_weights.size(); ++v)
    for (auto k = static_cast<std::size_t>(graph.offsets[v]);
         k < static_cast<std::size_t>(graph.offsets[v + 1]); ++k)
      visit(static_cast<local_id>(v), graph.neighbours[k], graph.edge_weights[k]);
}

/// Names an edge that is not in the rows of both of its ends, or of different weights there.
[[noreturn]] inline void throw_one_way(const csr_graph& graph) {
  struct arc {
    std::pair<local_id, local_id> ends; ///< sorted
    bool falls;                         ///< it is in the row of the larger end
    double weight;
  };
  std::vector<arc> arcs;
  for_each_arc(graph, [&](local_id v, local_id w, double weight) {
    arcs.push_back({std::minmax(v, w), w < v, weight});
  });
  std::stable_sort(arcs.begin(), arcs.end(), [](const arc& a, const arc& b) {
    return std::pair(a.ends, a.falls) < std::pair(b.ends, b.falls);
  });
  for (std::size_t first = 0, last = 0; first < arcs.size(); first = last) {
    double balance = 0, sum = 0;
    int rising = 0, falling = 0;
    for (; last < arcs.size() && arcs[last].ends == arcs[first].ends; ++last) {
      ++(arcs[last].falls ? falling : rising);
      balance += arcs[last].falls ? -arcs[last].weight : arcs[last].weight;
      sum += arcs[last].weight;
    }
    const auto [a, b] = arcs[first].ends;
    const auto name = [](local_id v) { return "node " + std::to_string(v); };
    if (rising != falling)
      refuse_graph(
          (rising > falling ? name(a) + " has " + name(b) : name(b) + " has " + name(a)) +
          " for a neighbour, but not the other way round; give every edge in the rows of both of its "
          "ends");
    if (std::abs(balance) > 1e-9 * sum)
      refuse_graph("the edge between " + name(a) + " and " + name(b) +
                   " has another weight in the row of one than in that of the other; give the same in both");
  }
  refuse_graph(
      "its edges are not the same in both directions; give every edge in the rows of both of its ends");
}

} // namespace dovetail::detail

namespace dovetail {

DOVETAIL_INLINE void require_valid_graph(const csr_graph& graph) {
  detail::require_rows(graph);
  const auto is_weight = [](double w) { return w >= 0 && w <= 1e300; };
  for (std::size_t v = 0; v < graph.node_weights.size(); ++v)
    if (!is_weight(graph.node_weights[v]))
      detail::refuse_graph("node " + std::to_string(v) + " has weight " +
                           std::to_string(graph.node_weights[v]) +
                           "; weights must be finite and not negative");
  const auto nodes = static_cast<local_id>(graph.node_weights.size());
  chain_sum ways; // nothing when every edge is passed in both directions
  double rising = 0, falling = 0, counted = 0;
  // Each edge counts by a factor of its own, so that weights which are wrong in two edges do not make up for
  // each other.
  const auto factor_of = [](local_id v, local_id w) {
    const auto [low, high] = std::minmax(v, w);
    return 1 + std::ldexp(static_cast<double>(detail::scattered(static_cast<std::uint64_t>(low) << 32U |
                                                                static_cast<std::uint64_t>(high)) >>
                                              11U),
                          -53);
  };
  detail::for_each_arc(graph, [&](local_id v, local_id w, double weight) {
    if (w < 0 || w >= nodes)
      detail::refuse_graph("node " + std::to_string(v) + " has the neighbour " + std::to_string(w) +
                           ", but there are " + std::to_string(nodes) + " nodes; they are numbered from 0");
    if (w == v)
      detail::refuse_graph("node " + std::to_string(v) + " is a neighbour of itself; leave self loops out");
    if (!is_weight(weight))
      detail::refuse_graph("the edge from node " + std::to_string(v) + " to node " + std::to_string(w) +
                           " has weight " + std::to_string(weight) +
                           "; weights must be finite and not negative");
    ways.add(std::array{v, w});
    (v < w ? rising : falling) += factor_of(v, w) * weight;
    counted += weight;
  });
  if (!(ways == chain_sum{}) || std::abs(rising - falling) > 1e-9 * counted)
    detail::throw_one_way(graph);
}

} // namespace dovetail
