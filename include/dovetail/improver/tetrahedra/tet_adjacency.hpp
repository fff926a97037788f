/// @file
/// Neighbours across the sides of tetrahedra, by bucketing the sides at their smallest vertex.
#pragma once

#include "dovetail/mesh/simplex.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::improvement {

/// One side of one element as a single number, 4 x element + local side; `no_id` stands for "nothing there".
using half_side = local_id;

/// Side `side` of an element as one number.
constexpr half_side half_side_of(local_id element, int side) {
  return static_cast<half_side>(4 * element + side);
}
/// The element of a half side.
constexpr local_id element_of(half_side h) {
  return h >> 2;
}
/// Which side of its element it is.
constexpr int side_of(half_side h) {
  return h & 3;
}

/// The vertices of a side in ascending order.
constexpr std::array<local_id, 3> sorted_side(const simplex<3>& element, int side) {
  const auto& local = numbering::sides<3>[side];
  local_id a = element[local[0]], b = element[local[1]], c = element[local[2]];
  if (a > b)
    std::swap(a, b);
  if (b > c)
    std::swap(b, c);
  if (a > b)
    std::swap(a, b);
  return {a, b, c};
}

/// Throws `mesh_error` when an element names a point that does not exist or one twice, or there are too many.
void check_vertices(std::span<const simplex<3>> elements, std::size_t points);

/// For each element and local side the half side that lies against it, or `no_id` on the boundary.
/// The elements must have passed `check_vertices`. O(elements) time; 48 bytes per element of working memory
/// besides the result. Throws `mesh_error` when more than two elements meet at a side; `numbers`, when there
/// are any, are what it calls the points by.
std::vector<std::array<half_side, 4>> match_sides(std::span<const simplex<3>> elements, std::size_t points,
                                                  std::span<const local_id> numbers = {});

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/tetrahedra/tet_adjacency.ipp"
#endif
