/// @file
/// What `any_distributed_partitioner.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/partition/any_distributed_partitioner.hpp"
#include "dovetail/partition/checked_partition.hpp"

#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<local_id>
any_distributed_partitioner::of_whole(any_communicator& network, const csr_graph& graph, int parts) const {
  if (!of_whole_)
    return parts_of_all(network, rows_of_rank(graph, network.rank(), network.size()), parts);
  const auto who = [&] { return named_policy("partitioner", name_); };
  auto all = network.once(
      [&] { return call_policy<partition_error>(who, [&] { return of_whole_(graph, parts); }); });
  detail::require_partition(all, graph.node_weights.size(), parts, who);
  return all;
}

DOVETAIL_INLINE std::vector<local_id>
any_distributed_partitioner::parts_of_all(any_communicator& network, const distributed_csr_graph& graph,
                                          int parts) const {
  const auto who = [&] { return named_policy("partitioner", name_); };
  const auto mine = call_policy<partition_error>(who, [&] { return call_(network, graph, parts); });
  std::vector<local_id> all;
  for (const auto& theirs : network.all_gather(mine))
    append(all, theirs);
  detail::require_partition(all, static_cast<std::size_t>(graph.node_count()), parts, who);
  return all;
}

} // namespace dovetail
