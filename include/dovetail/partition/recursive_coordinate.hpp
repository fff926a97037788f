/// @file
/// Recursive coordinate bisection: cuts across the longest side of the box, after M. J. Berger and S. H.
/// Bokhari, "A partitioning strategy for nonuniform problems on multiprocessors" (1987).
#pragma once

#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/node_positions.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::partition {

/// Parts are boxes before refinement. Needs `csr_graph::positions`. n log n per level.
struct recursive_coordinate {
  double imbalance = 1.03;   ///< heaviest part over average part
  int refinement_passes = 8; ///< of single moves that shrink the cut; 0: parts stay boxes

  /// The part in [0, parts) of every node. Throws `partition_error` when there are fewer nodes than parts or
  /// a node has no position.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    return detail::bisect_by_place(graph, parts, "recursive_coordinate", across_longest_side,
                                   {imbalance, refinement_passes});
  }

private:
  static std::vector<local_id> across_longest_side(const csr_graph& graph, int left, int right);
};

static_assert(graph_partitioner<recursive_coordinate>);

} // namespace dovetail::partition

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/recursive_coordinate.ipp"
#endif
