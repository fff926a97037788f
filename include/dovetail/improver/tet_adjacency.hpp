/// @file
/// Neighbours across the sides of tetrahedra, by bucketing the sides at their smallest vertex.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::improvement {

/// One side of one element as a single number, 4 x element + local side; `no_id` stands for "nothing there".
using half_side = local_id;

constexpr half_side half_side_of(local_id element, int side) {
  return static_cast<half_side>(4 * element + side);
}
constexpr local_id element_of(half_side h) {
  return h >> 2;
}
constexpr int side_of(half_side h) {
  return h & 3;
}

/// The vertices of a side in ascending order.
constexpr std::array<local_id, 3> sorted_side(const simplex<3>& element, int side) {
  const auto& local = numbering::sides<3>[static_cast<std::size_t>(side)];
  local_id a = element[static_cast<std::size_t>(local[0])], b = element[static_cast<std::size_t>(local[1])],
           c = element[static_cast<std::size_t>(local[2])];
  if (a > b)
    std::swap(a, b);
  if (b > c)
    std::swap(b, c);
  if (a > b)
    std::swap(a, b);
  return {a, b, c};
}

namespace detail {
/// A side filed under its smallest vertex: the other two and where it comes from.
struct filed_side {
  local_id middle, largest;
  half_side from;
};
} // namespace detail

/// For each element and local side the half side that lies against it, or `no_id` on the boundary.
/// O(elements) time; 48 bytes per element of working memory besides the result.
/// Throws `mesh_error` when an element names a point that does not exist or one twice, or when more than two
/// elements meet at a side.
inline std::vector<std::array<half_side, 4>> match_sides(std::span<const simplex<3>> elements,
                                                         std::size_t points) {
  std::vector<std::uint32_t> begins(points + 1, 0);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const local_id v : elements[e])
      if (v < 0 || static_cast<std::size_t>(v) >= points)
        throw mesh_error("element " + std::to_string(e) + " names point " + std::to_string(v) +
                         ", which does not exist");
  // A side's smallest vertex is the element's smallest, but for the one side opposite it.
  for (const auto& element : elements)
    for (int side = 0; side < 4; ++side)
      ++begins[static_cast<std::size_t>(sorted_side(element, side)[0])];
  std::uint32_t total = 0;
  for (auto& begin : begins)
    begin = std::exchange(total, total + begin);

  std::vector<detail::filed_side> filed(total);
  auto next = begins;
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (int side = 0; side < 4; ++side) {
      const auto v = sorted_side(elements[e], side);
      if (v[0] == v[1] || v[1] == v[2])
        throw mesh_error("element " + std::to_string(e) + " names a point twice");
      filed[next[static_cast<std::size_t>(v[0])]++] = {v[1], v[2],
                                                       half_side_of(static_cast<local_id>(e), side)};
    }

  std::vector<std::array<half_side, 4>> across(elements.size(), {no_id, no_id, no_id, no_id});
  const auto slot = [&](half_side h) -> half_side& {
    return across[static_cast<std::size_t>(element_of(h))][static_cast<std::size_t>(side_of(h))];
  };
  for (std::size_t v = 0; v < points; ++v)
    for (std::uint32_t i = begins[v]; i < begins[v + 1]; ++i) {
      const auto mine = filed[i];
      for (std::uint32_t j = i + 1; j < begins[v + 1]; ++j) {
        if (filed[j].middle != mine.middle || filed[j].largest != mine.largest)
          continue;
        if (slot(mine.from) != no_id || slot(filed[j].from) != no_id)
          throw mesh_error("more than two elements meet at a side of element " +
                           std::to_string(element_of(mine.from)));
        slot(mine.from) = filed[j].from;
        slot(filed[j].from) = mine.from;
      }
    }
  return across;
}

} // namespace dovetail::improvement
