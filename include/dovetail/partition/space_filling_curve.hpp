/// @file
/// Partition by cutting the order of the nodes along a Hilbert curve.
#pragma once

#include "dovetail/core/hilbert_curve.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/node_positions.hpp"
#include "dovetail/partition/recursive_bisection.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
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
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    detail::require_partitionable(graph, parts);
    detail::require_imbalance(imbalance);
    detail::require_positions(graph, "space_filling_curve");
    const std::vector<int> shares(static_cast<std::size_t>(parts), 1);
    std::vector<local_id> part = cut_order(order_along_curve(graph), graph.node_weights, shares);
    detail::finish_partition(graph, part, parts, imbalance, refinement_passes);
    return part;
  }

private:
  static constexpr int bits = 20;

  /// Axes along which the nodes do not spread are left out: in a plane the curve is the plane one.
  static std::vector<local_id> order_along_curve(const csr_graph& graph) {
    const box3 box = detail::box_of_positions(graph);
    const vec3 extent = box.upper - box.lower;
    const double longest = std::max({extent.x, extent.y, extent.z});
    std::array<int, 3> axes{};
    std::size_t used = 0;
    for (int k = 0; k < 3; ++k)
      if (extent[k] > 1e-9 * longest)
        axes[used++] = k;
    std::vector<std::uint64_t> places;
    places.reserve(graph.positions.size());
    const double cells = static_cast<double>(1U << bits);
    for (const vec3& p : graph.positions) {
      std::array<std::uint32_t, 3> cell{};
      for (std::size_t k = 0; k < used; ++k) {
        const double place = cells * (p[axes[k]] - box.lower[axes[k]]) / (longest * (1 + 1e-9));
        cell[k] = static_cast<std::uint32_t>(place);
      }
      places.push_back(used < 2    ? cell[0]
                       : used == 2 ? hilbert_place<2>({cell[0], cell[1]}, bits)
                                   : hilbert_place(cell, bits));
    }
    std::vector<local_id> order(places.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](local_id a, local_id b) {
      return places[static_cast<std::size_t>(a)] < places[static_cast<std::size_t>(b)];
    });
    return order;
  }
};

static_assert(graph_partitioner<space_filling_curve>);

} // namespace partition
} // namespace dovetail
