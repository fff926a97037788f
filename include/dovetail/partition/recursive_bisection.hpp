/// @file
/// Recursive bisection by any rule, and cutting an order of nodes into runs of given shares.
#pragma once

#include "dovetail/graph/contraction.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// A rule that bisects a graph; `recursive_bisection` makes a partitioner of it.
///
/// Valid expression for `const B& b`, `const csr_graph& g`, `int left`, `int right`: `b(g, left, right)` ->
/// std::vector<local_id>, 0 or 1 for every node.
///
/// Semantics: part 0 weighs about left / (left + right) of the whole, and the two have at least `left` and
/// `right` nodes when the graph has so many.
///
/// Complexity: at most n log n in the nodes and edges.
///
/// Failure: throws `partition_error`.
///
/// Models: the rules inside spectral, greedy, inertial, recursive_coordinate.
template <class B>
concept bisection_rule = requires(const B& b, const csr_graph& g, int left, int right) {
  { b(g, left, right) } -> std::same_as<std::vector<local_id>>;
};

/// Splits a graph into `parts` parts of about equal weight by repeated bisection. The rule's cost times about
/// log2(parts).
template <bisection_rule Bisect>
std::vector<local_id> recursive_bisection(const csr_graph& graph, int parts, const Bisect& bisect) {
  std::vector<local_id> part(static_cast<std::size_t>(graph.node_count()), 0);
  struct task {
    subgraph members; ///< of `graph`
    local_id first_part;
    int parts;
  };
  std::vector<task> tasks;
  tasks.push_back({{graph, {}}, 0, parts});
  tasks.back().members.nodes.resize(part.size());
  std::iota(tasks.back().members.nodes.begin(), tasks.back().members.nodes.end(), 0);
  while (!tasks.empty()) {
    const task whole = std::move(tasks.back());
    tasks.pop_back();
    const auto& nodes = whole.members.nodes;
    for (const local_id v : nodes)
      part[v] = whole.first_part;
    if (whole.parts < 2 || nodes.size() < 2)
      continue;
    const std::array shares{whole.parts / 2, whole.parts - whole.parts / 2};
    const std::vector<local_id> half = bisect(whole.members.graph, shares[0], shares[1]);
    local_id first_part = whole.first_part;
    for (const local_id side : {0, 1}) {
      task next{induced_subgraph(whole.members.graph, half, side), first_part, shares[side]};
      for (local_id& v : next.members.nodes)
        v = nodes[v];
      first_part += next.parts;
      tasks.push_back(std::move(next));
    }
  }
  return part;
}

/// Cuts a sequence of nodes into runs whose weights are as near as possible to the given shares of the whole;
/// run k gets at least shares[k] nodes, so the shares must not exceed the nodes. Returns the run of each
/// node. Linear.
std::vector<local_id> cut_order(std::span<const local_id> order, std::span<const double> node_weights,
                                std::span<const int> shares);

/// All nodes by growing key; equal keys by number.
std::vector<local_id> order_by(std::span<const double> keys);

/// Halves 0 and 1 of a graph by growing key, as a `bisection_rule` returns them.
/// \param left how many parts go left
/// \param right how many parts go right
inline std::vector<local_id> bisect_by_key(const csr_graph& graph, std::span<const double> keys, int left,
                                           int right) {
  const std::vector<int> shares{left, right};
  return cut_order(order_by(keys), graph.node_weights, shares);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/recursive_bisection.ipp"
#endif
