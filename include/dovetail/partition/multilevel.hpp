/// @file
/// Multilevel partitioning: a small graph is partitioned by any rule, and the partition refined on the way
/// back to the large one (B. Hendrickson and R. Leland, "A multilevel algorithm for partitioning graphs",
/// 1995).
#pragma once

#include "dovetail/partition/coarsening.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/partition/refinement.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dovetail {

/// Parameters of `partition_by_levels`.
struct multilevel_options {
  double imbalance = 1.03;        ///< heaviest part over average part
  std::uint64_t seed = 1;         ///< of the order in which nodes are matched
  int coarse_nodes_per_part = 30; ///< coarsening stops there
  int refinement_passes = 8;      ///< on each level, at most
};

/// The graphs above `graph`, each with half the nodes of the one below, until few are left or no two nodes
/// can be joined.
std::vector<coarsened_graph> coarsened_levels(const csr_graph& graph, int parts,
                                              const multilevel_options& options);

/// The partition that `partition_small(small graph, parts)` begins, refined by single moves on every level.
/// About n log n besides. Keeps the promises of a `graph_partitioner`. Throws `partition_error` for fewer
/// than two coarse nodes per part, with which a part may get none.
template <class Partition>
std::vector<local_id> partition_by_levels(const csr_graph& graph, int parts,
                                          const multilevel_options& options,
                                          const Partition& partition_small) {
  if (parts > 1)
    detail::require_coarse_nodes(options.coarse_nodes_per_part);
  const std::vector<coarsened_graph> levels = coarsened_levels(graph, parts, options);
  const auto refine = [&](const csr_graph& level, std::vector<local_id>& part) {
    detail::fill_empty_parts(level, part, parts);
    partition_refiner(level, part, equal_limits(level, parts, options.imbalance))
        .refine(options.refinement_passes);
  };
  const csr_graph& smallest = levels.empty() ? graph : levels.back().graph;
  std::vector<local_id> part = partition_small(smallest, parts);
  refine(smallest, part);
  for (std::size_t level = levels.size(); level-- > 0;) {
    const csr_graph& finer = level == 0 ? graph : levels[level - 1].graph;
    std::vector<local_id> projected(finer.node_weights.size());
    for (std::size_t v = 0; v < projected.size(); ++v)
      projected[v] = part[levels[level].node_of[v]];
    part = std::move(projected);
    refine(finer, part);
  }
  detail::level_parts(graph, part, parts, options.imbalance);
  return part;
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/multilevel.ipp"
#endif
