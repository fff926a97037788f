/// @file
/// Finds equal simplices in a long list by sorting: the kernel under adjacency, duplicates and contraction.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/sequence.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// The same vertices in growing order: the key under which equal simplices meet.
template <std::size_t N>
[[gnu::always_inline]] constexpr std::array<local_id, N> sorted_vertices(std::array<local_id, N> vertices) {
  // Sorting networks: this runs once per half-side of a mesh.
  const auto order = [&](std::size_t i, std::size_t j) {
    const local_id low = std::min(vertices[i], vertices[j]);
    const local_id high = std::max(vertices[i], vertices[j]);
    vertices[i] = low;
    vertices[j] = high;
  };
  if constexpr (N == 2) {
    order(0, 1);
  } else if constexpr (N == 3) {
    order(0, 1), order(1, 2), order(0, 1);
  } else if constexpr (N == 4) {
    order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  }
  return vertices;
}

namespace detail {

/// The vertices of a key but the first, two in one number: that is what a mesh's sides are compared by.
template <std::size_t N>
constexpr auto packed_rest(const std::array<std::uint32_t, N>& r) {
  if constexpr (N == 1)
    return 0;
  else if constexpr (N == 2)
    return r[0];
  else if constexpr (N == 3)
    return std::uint64_t{r[0]} << 32U | r[1];
  else
    return std::pair(std::uint64_t{r[0]} << 32U | r[1], r[2]);
}

} // namespace detail

/// Calls `visit(key, members)` once per distinct key, in lexicographic order of keys; `members` are the
/// indices i in [0, count) with `key_of(i) == key`, growing. Keys are sorted vertex lists below
/// `point_count`. Needs count < 2^32. A counting sort by the first vertex, then small sorts: about linear.
template <std::size_t N, class KeyOf, class Visit>
void for_each_group(std::size_t count, std::size_t point_count, const KeyOf& key_of, const Visit& visit) {
  using record = std::array<std::uint32_t, N>; // vertices 1 .. N-1 and, last, the index of the simplex
  const auto rest_of = [](const record& r) { return detail::packed_rest<N>(r); };
  const auto comes_first = [&](const record& a, const record& b) {
    const auto rest_of_a = rest_of(a), rest_of_b = rest_of(b);
    return rest_of_a != rest_of_b ? rest_of_a < rest_of_b : a[N - 1] < b[N - 1];
  };
  auto buckets = sorted_into_rows<record>(point_count, [&](const auto& put) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<local_id, N> key = key_of(i);
      record made;
      for (std::size_t k = 1; k < N; ++k)
        made[k - 1] = static_cast<std::uint32_t>(key[k]);
      made[N - 1] = static_cast<std::uint32_t>(i);
      put(key[0], made);
    }
  });
  std::vector<std::uint32_t> members;
  for (std::size_t v = 0; v < point_count; ++v) {
    const std::span<record> bucket = buckets[v];
    if constexpr (N > 1) // with N == 1 the bucket is one group and already in order
      sort_all(bucket, comes_first);
    for (std::size_t first = 0; first < bucket.size();) {
      std::array<local_id, N> key{};
      key[0] = static_cast<local_id>(v);
      for (std::size_t k = 1; k < N; ++k)
        key[k] = static_cast<local_id>(bucket[first][k - 1]);
      members.clear();
      std::size_t last = first;
      for (; last < bucket.size() && rest_of(bucket[last]) == rest_of(bucket[first]); ++last)
        members.push_back(bucket[last][N - 1]);
      visit(key, span_of(std::as_const(members)));
      first = last;
    }
  }
}

} // namespace dovetail
