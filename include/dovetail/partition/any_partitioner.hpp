/// @file
/// Any graph partitioner behind one type, so that the pipeline is compiled once and not once per partitioner.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/graph/require_valid_graph.hpp"
#include "dovetail/partition/concepts.hpp"

#include <concepts>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
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
    has_node[static_cast<std::size_t>(part[v])] = true;
  }
  for (std::size_t p = 0; p < has_node.size(); ++p)
    if (!has_node[p] && nodes >= has_node.size())
      refuse("left part " + std::to_string(p) + " of " + std::to_string(parts) + " without a node");
}

} // namespace detail

/// Holds any graph partitioner by value; a partitioner converts to it. A call costs one indirect call, a
/// look at the graph (`require_valid_graph`) and one at the result: a part in [0, parts) for every node, none
/// empty where there are nodes enough. Throws `partition_error` that names the partitioner otherwise.
class any_partitioner {
public:
  template <class P>
    requires(!std::same_as<P, any_partitioner> && graph_partitioner<P>)
  any_partitioner(P policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)), call_(std::move(policy)) {}

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    require_valid_graph(graph); // of one that is none, the partitioner is not to blame
    const auto who = [&] { return named_policy("partitioner", name_); };
    std::vector<local_id> part = call_policy<partition_error>(who, [&] { return call_(graph, parts); });
    detail::require_partition(part, graph.node_weights.size(), parts, who);
    return part;
  }

private:
  std::string name_;
  std::function<std::vector<local_id>(const csr_graph&, int)> call_;
};
static_assert(graph_partitioner<any_partitioner>);

} // namespace dovetail
