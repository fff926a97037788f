/// @file
/// Finds, for a side of an element, the boundary triangle a mesher was given there, and what lies on which
/// side of it. Shared by recovery, the flood fill, labels, checks and adapters.
#pragma once

#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// Lookup of oriented triangles. A triangle may be listed in both directions (an inner interface): an element
/// then belongs to each. Construction takes n log m for n triangles, m of them at one vertex, a lookup log m.
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
  explicit boundary_sides(std::span<const simplex<2>> triangles);

  /// One more than the highest vertex of all triangles.
  std::size_t vertex_count() const { return bucket_begins_.size() - 1; }
  /// Whether a vertex is one that triangles may have: it is no higher than theirs.
  bool may_have(local_id v) const { return v >= 0 && static_cast<std::size_t>(v) < vertex_count(); }
  /// The entry with the vertices of `side`, if there is one.
  match find(const simplex<2>& side) const {
    const auto [lowest, middle, highest] = sorted_vertices(side);
    if (!may_have(lowest))
      return {};
    std::size_t at = bucket_begins_[lowest], end = bucket_begins_[lowest + 1];
    while (end - at > few) {
      const std::size_t half = at + (end - at) / 2;
      const entry& one = entries_[half];
      (std::pair(middle, highest) < std::pair(one.middle, one.highest) ? end : at) = half;
    }
    for (; at < end; ++at)
      if (entries_[at].middle == middle && entries_[at].highest == highest)
        return {static_cast<local_id>(at), parity(side)};
    return {};
  }
  /// As they were given.
  const std::vector<simplex<2>>& triangles() const { return triangles_; }
  /// All triangles, each once whatever its directions.
  const std::vector<entry>& entries() const { return entries_; }
  /// The input triangle that is oriented like the side asked for; no_id when only its reverse was listed.
  local_id listed(match m) const { return entries_[m.entry].listed[m.parity]; }

  /// 0 when the cyclic order of the vertices is that of growing ids, else 1.
  static constexpr int parity(const simplex<2>& t) {
    return ((t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0])) == 2 ? 0 : 1;
  }

private:
  static constexpr std::size_t few = 8; // entries: so many are faster looked at one by one than halved

  /// One more than the largest vertex.
  static std::size_t count_points(std::span<const simplex<2>> triangles);

  /// Adds the next triangle of the last bucket.
  void append_to_bucket(const simplex<2>& triangle, local_id index);

  std::vector<simplex<2>> triangles_;
  std::vector<std::size_t> bucket_begins_; ///< per vertex: of the entries whose lowest it is
  std::vector<entry> entries_;             ///< in a bucket by their other vertices
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/boundary_sides.ipp"
#endif
