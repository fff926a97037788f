/// @file
/// What `boundary_sides.hpp` declares.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/boundary_sides.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE boundary_sides::boundary_sides(std::span<const simplex<2>> triangles)
    : triangles_(triangles.begin(), triangles.end()) {
  const std::size_t point_count = count_points(triangles);
  auto by_lowest = sorted_into_rows<local_id>(point_count, [&](const auto& put) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      put(static_cast<std::size_t>(sorted_vertices(triangles[t])[0]), static_cast<local_id>(t));
  });
  entries_.reserve(triangles.size());
  bucket_begins_.reserve(point_count + 1);
  for (std::size_t v = 0; v < point_count; ++v) {
    bucket_begins_.push_back(entries_.size());
    const auto key_of = [&](local_id t) { return sorted_vertices(triangles[t]); };
    sort_all(by_lowest[v], [&](local_id s, local_id t) {
      const auto key_of_s = key_of(s), key_of_t = key_of(t);
      return key_of_s != key_of_t ? key_of_s < key_of_t : s < t;
    });
    for (const local_id t : by_lowest[v])
      append_to_bucket(triangles[t], t);
  }
  bucket_begins_.push_back(entries_.size());
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

DOVETAIL_INLINE void boundary_sides::append_to_bucket(const simplex<2>& triangle, local_id index) {
  const auto key = sorted_vertices(triangle);
  const bool is_new = entries_.size() == bucket_begins_.back() || entries_.back().middle != key[1] ||
                      entries_.back().highest != key[2];
  if (is_new)
    entries_.push_back({key[1], key[2], {no_id, no_id}});
  local_id& slot = entries_.back().listed[parity(triangle)];
  if (slot != no_id)
    throw mesher_error("boundary triangles " + std::to_string(slot) + " and " + std::to_string(index) +
                       " are the same triangle in the same direction; remove one");
  slot = index;
}

} // namespace dovetail
