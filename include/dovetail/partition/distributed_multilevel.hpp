/// @file
/// What surrounds a library that partitions distributed graphs, so that it keeps the promises of the role.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/gathered.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/integer_weights.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <vector>

namespace dovetail::detail {

/// Calls `f()`; what it throws on one rank is thrown on all. Collective.
template <class F>
void agreed(any_communicator& network, const F& f) {
  std::exception_ptr failure;
  try {
    f();
  } catch (...) {
    failure = std::current_exception();
  }
  network.agree(failure);
}

/// Of a whole distributed graph.
struct graph_sums {
  weight_sums nodes;
  weight_sums edges; ///< each at both ends
};

/// Collective.
inline graph_sums sums_of(any_communicator& network, const csr_graph& rows) {
  graph_sums all;
  for (const graph_sums& more :
       network.all_gather(graph_sums{sums_of(rows.node_weights), sums_of(rows.edge_weights)})) {
    all.nodes.add(more.nodes);
    all.edges.add(more.edges);
  }
  return all;
}

/// Whether no part is empty or heavier than it may be. Collective.
inline bool keeps_promise(any_communicator& network, const csr_graph& rows, const std::vector<local_id>& part,
                          int parts, double most) {
  std::vector<double> nodes(static_cast<std::size_t>(parts), 0);
  for (const local_id p : part)
    ++nodes[static_cast<std::size_t>(p)];
  const auto add = [](const std::vector<double>& from, std::vector<double>& to) {
    std::transform(from.begin(), from.end(), to.begin(), to.begin(), std::plus<>());
  };
  std::vector<double> all_nodes(nodes.size(), 0), weights(nodes.size(), 0);
  for (const auto& [their_nodes, their_weights] :
       network.all_gather(std::pair(nodes, part_weights(rows, part, parts)))) {
    add(their_nodes, all_nodes);
    add(their_weights, weights);
  }
  return *std::min_element(all_nodes.begin(), all_nodes.end()) > 0 &&
         *std::max_element(weights.begin(), weights.end()) <= most * (1 + 1e-12);
}

/// What each rank's nodes get by `call(sums of the graph)`, collective too, if it keeps the promises of
/// the role; otherwise rank 0 gathers the graph and repairs that. Graphs that multilevel methods are not made
/// for go to `greedy`, and so do those of which a rank has no node, at which PT-Scotch hangs. Throws
/// `partition_error` as `greedy` does.
template <class Call>
std::vector<local_id> partition_distributed(any_communicator& network, const distributed_csr_graph& graph,
                                            int parts, double imbalance, int seed, const Call& call) {
  agreed(network, [&] {
    require_partitionable(graph.node_count(), graph.rows.node_weights, parts, graph.first());
    require_imbalance(imbalance);
  });
  if (parts == 1)
    return std::vector<local_id>(graph.rows.node_weights.size(), 0);
  const graph_sums sums = sums_of(network, graph.rows);
  const auto& firsts = graph.first_of_rank;
  if (is_too_small_for_multilevel(sums.nodes, sums.edges.count, parts) ||
      std::adjacent_find(firsts.begin(), firsts.end()) != firsts.end()) {
    const partition::greedy small{.imbalance = imbalance, .seed = static_cast<std::uint64_t>(seed)};
    return partition::gathered{small}(network, graph, parts);
  }
  std::vector<local_id> part = call(sums);
  const double average = sums.nodes.sum / parts;
  const double most = std::max(imbalance * average, average + sums.nodes.largest);
  if (keeps_promise(network, graph.rows, part, parts, most))
    return part;
  const csr_graph whole = gather_rows(network, graph);
  std::vector<local_id> all;
  for (const auto& theirs : network.gather(part))
    append(all, theirs);
  return own_share(network, graph, [&] {
    finish_partition(whole, all, parts, imbalance, 0);
    return all;
  });
}

} // namespace dovetail::detail
