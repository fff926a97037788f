/// @file
/// Quality counts of a surface, of the triangles that its fixed sides limit and of the rest.
#pragma once

#include "dovetail/improver/surface_complex.hpp"
#include "dovetail/improver/surface_limits.hpp"
#include "dovetail/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace dovetail::improvement {

/// Triangles with a smaller angle are low; under half of it they are bad.
inline constexpr double low_triangle_angle = 30;

/// Counts triangles by their smallest angle. Limited are those that touch a point where two fixed sides meet
/// at less than `low_triangle_angle` inside the mesh: no triangulation has a better angle there.
/// O(triangles).
inline quality_counts count_quality(const surface_complex& mesh) {
  const auto& table = mesh.table;
  const auto corners_of = [&](local_id t) {
    std::array<vec3, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = mesh.point[mesh.at(table.vertex[mesh.at(3 * t) + k])];
    return at;
  };
  std::vector<double> turned(mesh.point.size(), 0);
  for (local_id t = 0; t < table.triangle_slots(); ++t) {
    if (!table.alive(t))
      continue;
    const auto angles = wedge_angles(corners_of(t));
    for (std::size_t k = 0; k < 3; ++k)
      turned[mesh.at(table.vertex[mesh.at(3 * t) + k])] += angles[k];
  }
  std::vector<bool> is_limiting(mesh.point.size(), false);
  for (local_id v = 0; v < mesh.frozen; ++v) {
    const bool is_sharp = turned[mesh.at(v)] < low_triangle_angle - 1e-9;
    for (local_id fan = v; is_sharp && !is_limiting[mesh.at(fan)]; fan = mesh.next_fan[mesh.at(fan)])
      is_limiting[mesh.at(fan)] = true;
  }
  quality_counts counts;
  for (local_id t = 0; t < table.triangle_slots(); ++t) {
    if (!table.alive(t))
      continue;
    bool is_limited = false;
    for (local_id c = 3 * t; c < 3 * t + 3; ++c)
      is_limited = is_limited || is_limiting[mesh.at(table.vertex[mesh.at(c)])];
    auto& counted = is_limited ? counts.limited : counts.free;
    ++counted.elements;
    if (!(mesh.quality(t) > 0)) {
      ++counted.inverted;
      ++counted.bad;
      ++counted.low;
      continue;
    }
    const auto angles = wedge_angles(corners_of(t));
    const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
    counted.low += *least < low_triangle_angle - 1e-9;
    counted.bad += *least < 0.5 * low_triangle_angle;
    counted.min_angle = std::min(counted.min_angle, *least);
    counted.max_angle = std::max(counted.max_angle, *most);
  }
  return counts;
}

} // namespace dovetail::improvement
