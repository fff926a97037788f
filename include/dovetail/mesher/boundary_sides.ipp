/// @file
/// What `boundary_sides.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/boundary_sides.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE boundary_sides::boundary_sides(std::span<const simplex<2>> triangles) {
  const std::size_t point_count = count_points(triangles);
  bucket_begins_.assign(point_count + 1, 0);
  for (const auto& triangle : triangles)
    ++bucket_begins_[static_cast<std::size_t>(sorted_vertices(triangle)[0]) + 1];
  for (std::size_t v = 0; v < point_count; ++v)
    bucket_begins_[v + 1] += bucket_begins_[v];
  entries_.resize(triangles.size());
  std::vector<std::size_t> used(point_count, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    insert(triangles[t], static_cast<local_id>(t), used);
  pack(used);
}

DOVETAIL_INLINE boundary_sides::match boundary_sides::find(const simplex<2>& side) const {
  const auto key = sorted_vertices(side);
  if (static_cast<std::size_t>(key[2]) + 1 >= bucket_begins_.size())
    return {};
  const auto bucket = static_cast<std::size_t>(key[0]);
  for (std::size_t k = bucket_begins_[bucket]; k < bucket_begins_[bucket + 1]; ++k)
    if (entries_[k].middle == key[1] && entries_[k].highest == key[2])
      return {static_cast<local_id>(k), parity(side)};
  return {};
}

DOVETAIL_INLINE std::size_t boundary_sides::count_points(std::span<const simplex<2>> triangles) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto key = sorted_vertices(triangles[t]);
    if (key[0] < 0 || key[0] == key[1] || key[1] == key[2])
      throw mesher_error("boundary triangle " + std::to_string(t) + " has a repeated or a negative vertex");
    count = std::max(count, static_cast<std::size_t>(key[2]) + 1);
  }
  return count;
}

DOVETAIL_INLINE void boundary_sides::insert(const simplex<2>& triangle, local_id index,
                                            std::vector<std::size_t>& used) {
  const auto key = sorted_vertices(triangle);
  const auto bucket = static_cast<std::size_t>(key[0]);
  const std::size_t begin = bucket_begins_[bucket];
  std::size_t k = begin;
  while (k < begin + used[bucket] && (entries_[k].middle != key[1] || entries_[k].highest != key[2]))
    ++k;
  if (k == begin + used[bucket]) {
    entries_[k] = {key[1], key[2], {no_id, no_id}};
    ++used[bucket];
  }
  local_id& slot = entries_[k].listed[parity(triangle)];
  if (slot != no_id)
    throw mesher_error("boundary triangles " + std::to_string(slot) + " and " + std::to_string(index) +
                       " are the same triangle in the same direction; remove one");
  slot = index;
}

DOVETAIL_INLINE void boundary_sides::pack(const std::vector<std::size_t>& used) {
  std::size_t end = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    const std::size_t begin = bucket_begins_[v];
    bucket_begins_[v] = end;
    for (std::size_t k = begin; k < begin + used[v]; ++k)
      entries_[end++] = entries_[k];
  }
  bucket_begins_.back() = end;
  entries_.resize(end);
}

} // namespace dovetail
