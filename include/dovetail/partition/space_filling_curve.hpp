/// @file
/// Partition by cutting the order of the nodes along a Hilbert curve.
#pragma once

#include "dovetail/partition/concepts.hpp"

#include <vector>

namespace dovetail {

namespace partition {

/// Sorts the nodes along a Hilbert curve through their box and cuts the sequence into runs of equal weight.
/// The quickest of all, and parts change little when the graph does. Needs `csr_graph::positions`. n log n.
struct space_filling_curve {
  double imbalance = 1.03;   ///< heaviest part over average part
  int refinement_passes = 8; ///< of single moves that shrink the cut; 0: parts stay runs of the curve

  /// The part in [0, parts) of every node. Throws `partition_error` when there are fewer nodes than parts or
  /// a node has no position.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const;

private:
  static constexpr int bits = 20;

  /// Axes along which the nodes do not spread are left out: in a plane the curve is the plane one.
  static std::vector<local_id> order_along_curve(const csr_graph& graph);
};

static_assert(graph_partitioner<space_filling_curve>);

} // namespace partition
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/space_filling_curve.ipp"
#endif
