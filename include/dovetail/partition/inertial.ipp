/// @file
/// What `inertial.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/geometry/frame.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/partition/node_positions.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::partition {

DOVETAIL_INLINE std::vector<local_id> inertial::across_principal_axis(const csr_graph& graph, int left,
                                                                      int right) {
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

DOVETAIL_INLINE vec3 inertial::preferred_axis(const csr_graph& graph, vec3 mean, vec3 principal) {
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

} // namespace dovetail::partition
