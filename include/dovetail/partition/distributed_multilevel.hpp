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
#include <cstdint>
#include <exception>
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
graph_sums sums_of(any_communicator& network, const csr_graph& rows);

/// Whether no part is empty or heavier than it may be. Collective.
bool keeps_promise(any_communicator& network, const csr_graph& rows, const std::vector<local_id>& part,
                   int parts, double most);

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

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/distributed_multilevel.ipp"
#endif
