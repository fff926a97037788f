/// @file
/// What `greedy.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/bisection.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/multilevel.hpp"
#include "dovetail/partition/recursive_bisection.hpp"

namespace dovetail::partition {

DOVETAIL_INLINE std::vector<local_id> greedy::operator()(const csr_graph& graph, int parts) const {
  detail::require_partitionable(graph, parts);
  detail::require_imbalance(imbalance);
  if (parts == 1)
    return std::vector<local_id>(graph.node_weights.size(), 0);
  const auto grow_and_refine = [this](const csr_graph& whole, int left, int right) {
    return detail::bisect(whole, static_cast<double>(left) / (left + right), imbalance);
  };
  return partition_by_levels(
      graph, parts, {.imbalance = imbalance, .seed = seed, .coarse_nodes_per_part = coarse_nodes_per_part},
      [&](const csr_graph& small, int all) { return recursive_bisection(small, all, grow_and_refine); });
}

} // namespace dovetail::partition
