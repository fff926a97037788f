/// @file
/// What `curve_order.hpp` declares.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/hilbert_curve.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/improver/tetrahedra/curve_order.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dovetail::improvement::detail {

inline constexpr int curve_levels = 16; ///< cells per axis: 2^16

/// Stable; by counting, digit after digit. O(points).
inline void sort_by_place(std::vector<placed_point>& points) {
  constexpr unsigned digit_bits = 12, mask = (1U << digit_bits) - 1;
  for (unsigned shift = 0; shift < 3 * curve_levels; shift += digit_bits) {
    auto sorted = sorted_into_rows<placed_point>(mask + 1, [&](const auto& put) {
      for (const auto& p : points)
        put(p.place >> shift & mask, p);
    });
    points = std::move(sorted.items);
  }
}

DOVETAIL_INLINE std::vector<placed_point> along_curve(const std::vector<vec3>& points) {
  std::vector<placed_point> placed(points.size());
  if (points.empty())
    return placed;
  vec3 lower = points[0], upper = points[0];
  for (const vec3& p : points) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
  }
  const vec3 extent = upper - lower;
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double scale = longest > 0 ? ((1U << curve_levels) - 1) / longest : 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const vec3 place = scale * (points[v] - lower);
    const std::array cell{static_cast<std::uint32_t>(place.x), static_cast<std::uint32_t>(place.y),
                          static_cast<std::uint32_t>(place.z)};
    placed[v] = {hilbert_place(cell, curve_levels), static_cast<local_id>(v)};
  }
  sort_by_place(placed);
  return placed;
}

/// Renames the elements' points and sorts the elements, with their tags, by their smallest new name; those
/// that share it keep their order. O(elements).
inline void rename_and_sort(simplicial_mesh<3>& mesh, const std::vector<local_id>& names) {
  const auto first_of = [](const simplex<3>& v) {
    return static_cast<std::size_t>(std::min(std::min(v[0], v[1]), std::min(v[2], v[3])));
  };
  for (auto& element : mesh.elements)
    for (auto& v : element)
      v = names[v];
  const auto sorted = sorted_into_rows<std::uint32_t>(names.size(), [&](const auto& put) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      put(first_of(mesh.elements[e]), static_cast<std::uint32_t>(e));
  });
  std::vector<simplex<3>> elements;
  std::vector<local_id> tags;
  elements.reserve(mesh.elements.size());
  tags.reserve(mesh.tags.size());
  for (const std::uint32_t e : sorted.items) {
    elements.push_back(mesh.elements[e]);
    if (!mesh.tags.empty())
      tags.push_back(mesh.tags[e]);
  }
  mesh.elements = std::move(elements);
  mesh.tags = std::move(tags);
}

} // namespace dovetail::improvement::detail

namespace dovetail::improvement {

DOVETAIL_INLINE std::vector<local_id> order_along_curve(simplicial_mesh<3>& mesh) {
  const auto order = detail::along_curve(mesh.points);
  std::vector<local_id> numbers_before(order.size()), numbers_now(order.size());
  std::vector<vec3> points(order.size());
  for (std::size_t v = 0; v < order.size(); ++v) {
    const auto before = static_cast<std::size_t>(order[v].point);
    points[v] = mesh.points[before];
    numbers_before[v] = order[v].point;
    numbers_now[before] = static_cast<local_id>(v);
  }
  mesh.points = std::move(points);
  detail::rename_and_sort(mesh, numbers_now);
  return numbers_before;
}

} // namespace dovetail::improvement
