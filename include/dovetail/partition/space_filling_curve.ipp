/// @file
/// What `space_filling_curve.hpp` declares.
#pragma once

#include "dovetail/core/hilbert_curve.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/node_positions.hpp"
#include "dovetail/partition/recursive_bisection.hpp"
#include "dovetail/partition/space_filling_curve.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace dovetail::partition {

DOVETAIL_INLINE std::vector<local_id> space_filling_curve::operator()(const csr_graph& graph,
                                                                      int parts) const {
  detail::require_partitionable(graph, parts);
  detail::require_imbalance(imbalance);
  detail::require_positions(graph, "space_filling_curve");
  const std::vector<int> shares(static_cast<std::size_t>(parts), 1);
  std::vector<local_id> part = cut_order(order_along_curve(graph), graph.node_weights, shares);
  detail::finish_partition(graph, part, parts, imbalance, refinement_passes);
  return part;
}

DOVETAIL_INLINE std::vector<local_id> space_filling_curve::order_along_curve(const csr_graph& graph) {
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
  std::stable_sort(order.begin(), order.end(), [&](local_id a, local_id b) { return places[a] < places[b]; });
  return order;
}

} // namespace dovetail::partition
