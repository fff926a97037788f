/// @file
/// What partitioners that go by place have in common.
#pragma once

#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/partition/recursive_bisection.hpp"

#include <string>
#include <vector>

namespace dovetail::detail {

/// Throws `partition_error` unless every node has a finite position. `name` is the partitioner's.
void require_positions(const csr_graph& graph, const std::string& name);

/// The smallest box around all nodes.
box3 box_of_positions(const csr_graph& graph);

/// Parameters of `bisect_by_place`.
struct place_options {
  double imbalance; ///< heaviest part over average part
  int refinement_passes;
};

/// The partitioner `who` that bisects by a rule about the positions.
template <bisection_rule Bisect>
std::vector<local_id> bisect_by_place(const csr_graph& graph, int parts, const char* who,
                                      const Bisect& bisect, const place_options& options) {
  require_partitionable(graph, parts);
  require_imbalance(options.imbalance);
  require_positions(graph, who);
  std::vector<local_id> part = recursive_bisection(graph, parts, bisect);
  finish_partition(graph, part, parts, options.imbalance, options.refinement_passes);
  return part;
}

} // namespace dovetail::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/node_positions.ipp"
#endif
