/// @file
/// What `tet_adjacency.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/tetrahedra/tet_adjacency.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::improvement {

DOVETAIL_INLINE void check_vertices(std::span<const simplex<3>> elements, std::size_t points) {
  if (elements.size() > (std::size_t{1} << 29U))
    throw mesh_error("more than 2^29 elements in one mesh: improve it in pieces");
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto& v = elements[e];
    for (const local_id i : v)
      if (i < 0 || static_cast<std::size_t>(i) >= points)
        throw mesh_error("element " + std::to_string(e) + " names point " + std::to_string(i) +
                         ", which does not exist");
    if (v[0] == v[1] || v[0] == v[2] || v[0] == v[3] || v[1] == v[2] || v[1] == v[3] || v[2] == v[3])
      throw mesh_error("element " + std::to_string(e) + " names a point twice");
  }
}

} // namespace dovetail::improvement

namespace dovetail::improvement::detail {

/// A side filed under its smallest vertex: the other two and where it comes from.
struct filed_side {
  local_id middle, largest;
  half_side from;
};

/// The vertices of an element in ascending order, each with its corner in the two lowest bits.
inline std::array<std::uint64_t, 4> sorted_corners(const simplex<3>& element) {
  std::array<std::uint64_t, 4> s;
  for (std::size_t k = 0; k < 4; ++k)
    s[k] = static_cast<std::uint64_t>(element[k]) << 2 | k;
  const auto order = [&s](std::size_t i, std::size_t j) { // without branches: they could not be foretold
    const std::uint64_t exchanged = (s[i] ^ s[j]) & (std::uint64_t{0} - std::uint64_t{s[i] > s[j]});
    s[i] ^= exchanged;
    s[j] ^= exchanged;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return s;
}

[[noreturn]] inline void refuse_side(std::array<local_id, 3> side, std::span<const local_id> numbers) {
  if (!numbers.empty())
    for (auto& v : side)
      v = numbers[v];
  sort_all(side);
  throw mesh_error("more than two elements meet at the side (" + std::to_string(side[0]) + ", " +
                   std::to_string(side[1]) + ", " + std::to_string(side[2]) + ")");
}

/// Pairs the sides filed under one vertex, by a small hash table whose slots are named by entry number.
class bucket_matcher {
public:
  template <class Join>
  void match(std::span<const filed_side> sides, const Join& join) {
    const std::size_t slots = std::bit_ceil(2 * sides.size());
    if (table_.size() < slots)
      table_.resize(slots);
    std::fill_n(table_.begin(), slots, empty);
    for (std::uint32_t i = 0; i < sides.size(); ++i) {
      const filed_side& mine = sides[i];
      std::size_t at = slot_of(mine) & (slots - 1);
      while (table_[at] != empty &&
             (sides[table_[at]].middle != mine.middle || sides[table_[at]].largest != mine.largest))
        at = (at + 1) & (slots - 1);
      if (table_[at] == empty)
        table_[at] = i;
      else
        join(sides[table_[at]].from, mine.from);
    }
  }

private:
  static constexpr std::uint32_t empty = ~std::uint32_t{0};
  static std::size_t slot_of(const filed_side& side) {
    const auto both =
        static_cast<std::uint64_t>(side.middle) << 32U | static_cast<std::uint64_t>(side.largest);
    return both * 0x9e3779b97f4a7c15U >> 32U;
  }
  std::vector<std::uint32_t> table_;
};

} // namespace dovetail::improvement::detail

namespace dovetail::improvement {

DOVETAIL_INLINE std::vector<std::array<half_side, 4>>
match_sides(std::span<const simplex<3>> elements, std::size_t points, std::span<const local_id> numbers) {
  // Three sides of an element have its smallest vertex; that of the fourth is the second smallest.
  std::vector<std::uint32_t> begins(points + 1, 0);
  for (const auto& element : elements) {
    const auto s = detail::sorted_corners(element);
    begins[s[0] >> 2U] += 3;
    begins[s[1] >> 2U] += 1;
  }
  std::uint32_t total = 0;
  for (auto& begin : begins)
    begin = std::exchange(total, total + begin);

  // Filing moves each bucket's begin to its end, which is the begin of the next one.
  std::vector<detail::filed_side> filed(total);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto s = detail::sorted_corners(elements[e]);
    std::array<local_id, 4> v{};
    std::array<half_side, 4> opposite{};
    for (std::size_t k = 0; k < 4; ++k) {
      v[k] = static_cast<local_id>(s[k] >> 2U);
      opposite[k] = half_side_of(static_cast<local_id>(e), static_cast<int>(s[k] & 3U));
    }
    auto& first = begins[s[0] >> 2U];
    filed[first] = {v[1], v[2], opposite[3]};
    filed[first + 1] = {v[1], v[3], opposite[2]};
    filed[first + 2] = {v[2], v[3], opposite[1]};
    first += 3;
    filed[begins[s[1] >> 2U]++] = {v[2], v[3], opposite[0]};
  }

  std::vector<std::array<half_side, 4>> across(elements.size(), {no_id, no_id, no_id, no_id});
  const auto slot = [&](half_side h) -> half_side& { return across[element_of(h)][side_of(h)]; };
  const auto join = [&](half_side one, half_side other) {
    if (slot(one) != no_id)
      detail::refuse_side(sorted_side(elements[element_of(one)], side_of(one)), numbers);
    slot(one) = other;
    slot(other) = one;
  };
  detail::bucket_matcher matcher;
  for (std::size_t v = 0; v < points; ++v) {
    const std::uint32_t begin = v == 0 ? 0 : begins[v - 1];
    matcher.match({filed.data() + begin, begins[v] - begin}, join);
  }
  return across;
}

} // namespace dovetail::improvement
