/// @file
/// What `surface_quality.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/quality_counts.hpp"
#include "dovetail/improver/triangles/surface_complex.hpp"
#include "dovetail/improver/triangles/surface_quality.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace dovetail::improvement {

DOVETAIL_INLINE std::vector<bool> limiting_points(const surface_complex& mesh) {
  const auto& table = mesh.table;
  std::vector<double> turned(mesh.frozen, 0);
  for (local_id c = 0; c < static_cast<local_id>(table.vertex.size()); ++c)
    if (const local_id v = table.vertex[c]; v != no_id && v < mesh.frozen) {
      const vec3 p = mesh.point[v];
      const vec3 a = mesh.point[table.tail(c)] - p, b = mesh.point[table.head(c)] - p;
      turned[v] += std::atan2(norm(cross(a, b)), dot(a, b));
    }
  std::vector<bool> is_limiting(mesh.point.size(), false);
  for (local_id v = 0; v < mesh.frozen; ++v) {
    const bool is_sharp = turned[v] < (low_triangle_angle - 1e-9) * std::numbers::pi / 180;
    for (local_id fan = v; is_sharp && !is_limiting[fan]; fan = mesh.next_fan[fan])
      is_limiting[fan] = true;
  }
  return is_limiting;
}

DOVETAIL_INLINE std::array<double, 2> extreme_cosines(vec3 a, vec3 b, vec3 c) {
  std::array<double, 3> squares{norm_squared(b - a), norm_squared(c - b), norm_squared(a - c)};
  sort_all(squares);
  const auto& [x, y, z] = squares;
  return {(y + z - x) / (2 * std::sqrt(y * z)), (x + y - z) / (2 * std::sqrt(x * y))};
}

DOVETAIL_INLINE quality_counts count_quality(const surface_complex& mesh) {
  quality_counter counter(low_triangle_angle - 1e-9, 0.5 * low_triangle_angle);
  const auto& table = mesh.table;
  const auto is_limiting = limiting_points(mesh);
  for (local_id t = 0; t < table.triangle_slots(); ++t) {
    if (!table.alive(t))
      continue;
    std::array<std::size_t, 3> v;
    for (std::size_t k = 0; k < 3; ++k)
      v[k] = table.vertex[3 * t + k];
    const bool is_limited = is_limiting[v[0]] || is_limiting[v[1]] || is_limiting[v[2]];
    if (!(mesh.quality(t) > 0)) {
      counter.add_inverted(is_limited);
      continue;
    }
    const auto [of_smallest, of_largest] =
        extreme_cosines(mesh.point[v[0]], mesh.point[v[1]], mesh.point[v[2]]);
    counter.add(is_limited, of_smallest, of_largest);
  }
  return counter.result();
}

} // namespace dovetail::improvement
