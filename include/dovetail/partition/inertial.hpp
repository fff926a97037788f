/// @file
/// Recursive inertial bisection: cuts across the axis along which the nodes spread most, after H. D. Simon,
/// "Partitioning of unstructured problems for parallel processing" (1991).
#pragma once

#include "dovetail/geometry/frame.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/node_positions.hpp"

#include <cstddef>
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
  static std::vector<local_id> across_principal_axis(const csr_graph& graph, int left, int right) {
    const vec3 center = detail::box_of_positions(graph).center(); // moments lose digits far from the origin
    discrete::vector_moments moments;
    for (std::size_t v = 0; v < graph.positions.size(); ++v)
      moments.add(graph.positions[v] - center, graph.node_weights[v]);
    const vec3 axis = preferred_axis(graph, center + moments.mean(), moments.principal_axis());
    std::vector<double> keys;
    keys.reserve(graph.positions.size());
    for (const vec3& p : graph.positions)
      keys.push_back(dot(p - center, axis));
    return bisect_by_key(graph, keys, left, right);
  }

  /// The principal axis, or a coordinate axis along which the nodes spread almost as much: in a cube all
  /// directions are equal, and a cut across its diagonal is far larger.
  static vec3 preferred_axis(const csr_graph& graph, vec3 mean, vec3 principal) {
    constexpr double almost = 0.95;
    const auto spread = [&](vec3 axis) {
      double sum = 0;
      for (std::size_t v = 0; v < graph.positions.size(); ++v) {
        const double along = dot(graph.positions[v] - mean, axis);
        sum += graph.node_weights[v] * along * along;
      }
      return sum;
    };
    vec3 best = principal;
    double largest = almost * spread(principal);
    for (const vec3 axis : {vec3{1, 0, 0}, vec3{0, 1, 0}, vec3{0, 0, 1}})
      if (const double s = spread(axis); s > largest) {
        largest = s;
        best = axis;
      }
    return best;
  }
};

static_assert(graph_partitioner<inertial>);

} // namespace dovetail::partition
