/// @file
/// The call of a partitioner, with a look at what goes in and what comes out: no partitioner is trusted.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/policy.hpp"
#include "dovetail/graph/require_valid_graph.hpp"
#include "dovetail/partition/concepts.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail {

namespace detail {

/// Throws `partition_error` that begins with `who()` unless every node has a part in [0, parts) and, where
/// there are nodes enough, every part a node.
template <class Who>
void require_partition(const std::vector<local_id>& part, std::size_t nodes, int parts, const Who& who) {
  const auto refuse = [&](const std::string& why) { throw partition_error(who() + " " + why); };
  if (part.size() != nodes)
    refuse("put " + std::to_string(part.size()) + " nodes into parts, the graph has " +
           std::to_string(nodes));
  std::vector<bool> has_node(static_cast<std::size_t>(parts), false);
  for (std::size_t v = 0; v < nodes; ++v) {
    if (part[v] < 0 || part[v] >= parts)
      refuse("put node " + std::to_string(v) + " into part " + std::to_string(part[v]) + " of " +
             std::to_string(parts));
    has_node[part[v]] = true;
  }
  for (std::size_t p = 0; p < has_node.size(); ++p)
    if (!has_node[p] && nodes >= has_node.size())
      refuse("left part " + std::to_string(p) + " of " + std::to_string(parts) + " without a node");
}

} // namespace detail

/// The parts of a graph by a partitioner, which errors call by `name`. Throws `partition_error` for anything
/// but a part in [0, parts) for every node, none empty where there are nodes enough, for what the partitioner
/// throws that is no error of ours, and for a graph that is none (`require_valid_graph`).
/// Complexity: that of the partitioner, and linear in the graph.
/// \param partitioner any `graph_partitioner`
/// \param graph the graph to divide
/// \param parts how many are wanted, at least 1
/// \param name what messages call the partitioner
template <graph_partitioner Partitioner>
std::vector<local_id> checked_partition(const Partitioner& partitioner, const csr_graph& graph, int parts,
                                        const std::string& name) {
  require_valid_graph(graph); // of one that is none, the partitioner is not to blame
  const auto who = [&] { return named_policy("partitioner", name); };
  std::vector<local_id> part = call_policy<partition_error>(who, [&] { return partitioner(graph, parts); });
  detail::require_partition(part, graph.node_weights.size(), parts, who);
  return part;
}
template <graph_partitioner Partitioner>
std::vector<local_id> checked_partition(const Partitioner& partitioner, const csr_graph& graph, int parts) {
  return checked_partition(partitioner, graph, parts, policy_name(partitioner));
}

} // namespace dovetail
