/// @file
/// Recursive inertial bisection: cuts across the axis along which the nodes spread most, after H. D. Simon,
/// "Partitioning of unstructured problems for parallel processing" (1991).
#pragma once

#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/node_positions.hpp"

#include <vector>

namespace dovetail::partition {

/// Like `recursive_coordinate`, but cuts are at right angles to the principal axis of the weighted positions,
/// whatever its direction. Needs `csr_graph::positions`. n log n per level.
struct inertial {
  double imbalance = 1.03;   ///< heaviest part over average part
  int refinement_passes = 8; ///< of single moves that shrink the cut; 0: cuts stay plane

  /// The part in [0, parts) of every node. Throws `partition_error` when there are fewer nodes than parts or
  /// a node has no position.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    return detail::bisect_by_place(graph, parts, "inertial", across_principal_axis,
                                   {imbalance, refinement_passes});
  }

private:
  static std::vector<local_id> across_principal_axis(const csr_graph& graph, int left, int right);

  /// The principal axis, or a coordinate axis along which the nodes spread almost as much: in a cube all
  /// directions are equal, and a cut across its diagonal is far larger.
  static vec3 preferred_axis(const csr_graph& graph, vec3 mean, vec3 principal);
};

static_assert(graph_partitioner<inertial>);

} // namespace dovetail::partition

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/inertial.ipp"
#endif
