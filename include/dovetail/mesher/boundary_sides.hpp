/// @file
/// Finds, for a side of an element, the boundary triangle a mesher was given there, and what lies on which
/// side of it. Shared by the checks and by the flood fill.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

/// Lookup of oriented triangles. A triangle may be listed in both directions (an inner interface): an element
/// then belongs to each. Construction is linear, a lookup takes constant time (the triangles at one vertex).
class boundary_sides {
public:
  /// One triangle as a set of three vertices.
  struct entry {
    local_id middle;  ///< vertices in growing order: lowest (the bucket), middle, highest
    local_id highest; ///< of its three vertices
    std::array<local_id, 2> listed{no_id, no_id}; ///< index of the input triangle of even and odd parity
  };
  /// An entry, and the parity with which the side that was asked for is oriented.
  struct match {
    local_id entry = no_id; ///< a number among `entries()`; no_id where there is none
    int parity = 0;         ///< of the side that was asked for: an index of `entry::listed`
    explicit operator bool() const { return entry != no_id; } ///< whether there is an entry
  };

  /// Throws `mesher_error` when a triangle is degenerate or listed twice in the same direction.
  explicit boundary_sides(std::span<const simplex<2>> triangles) {
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

  /// The entry with the vertices of `side`, if there is one.
  match find(const simplex<2>& side) const {
    const auto key = sorted_vertices(side);
    if (static_cast<std::size_t>(key[2]) + 1 >= bucket_begins_.size())
      return {};
    const auto bucket = static_cast<std::size_t>(key[0]);
    for (std::size_t k = bucket_begins_[bucket]; k < bucket_begins_[bucket + 1]; ++k)
      if (entries_[k].middle == key[1] && entries_[k].highest == key[2])
        return {static_cast<local_id>(k), parity(side)};
    return {};
  }
  /// All triangles, each once whatever its directions.
  const std::vector<entry>& entries() const { return entries_; }
  /// The input triangle that is oriented like the side asked for; no_id when only its reverse was listed.
  local_id listed(match m) const {
    return entries_[static_cast<std::size_t>(m.entry)].listed[static_cast<std::size_t>(m.parity)];
  }

  /// 0 when the cyclic order of the vertices is that of growing ids, else 1.
  static constexpr int parity(const simplex<2>& t) {
    return ((t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0])) == 2 ? 0 : 1;
  }

private:
  /// One more than the largest vertex.
  static std::size_t count_points(std::span<const simplex<2>> triangles) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto key = sorted_vertices(triangles[t]);
      if (key[0] < 0 || key[0] == key[1] || key[1] == key[2])
        throw mesher_error("boundary triangle " + std::to_string(t) + " has a repeated or a negative vertex");
      count = std::max(count, static_cast<std::size_t>(key[2]) + 1);
    }
    return count;
  }

  void insert(const simplex<2>& triangle, local_id index, std::vector<std::size_t>& used) {
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
    local_id& slot = entries_[k].listed[static_cast<std::size_t>(parity(triangle))];
    if (slot != no_id)
      throw mesher_error("boundary triangles " + std::to_string(slot) + " and " + std::to_string(index) +
                         " are the same triangle in the same direction; remove one");
    slot = index;
  }

  /// Closes the gaps that triangles listed in both directions left.
  void pack(const std::vector<std::size_t>& used) {
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

  std::vector<std::size_t> bucket_begins_;
  std::vector<entry> entries_;
};

} // namespace dovetail
