/// @file
/// Sums of oriented simplices, to compare chains without sorting them.
#pragma once

#include "dovetail/mesh/simplex_grouping.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace dovetail {

/// Oriented simplices added up: one that is passed in both directions adds nothing. Sums of equal chains are
/// equal; those of different ones are so by a chance of 2^-64.
class chain_sum {
public:
  /// Adds one oriented simplex.
  template <std::size_t N>
  void add(const std::array<local_id, N>& side) {
    std::size_t descents = 0; // in cyclic order, so that an even permutation keeps their parity
    for (std::size_t k = 0; k < N; ++k)
      descents += side[k] > side[(k + 1) % N] ? 1 : 0;
    const bool reversed = N == 3 ? descents == 2 : side[0] > side[1];
    const auto sorted = sorted_vertices(side);
    const auto bits = [&](std::size_t k) { return std::uint64_t{static_cast<std::uint32_t>(sorted[k])}; };
    std::uint64_t mixed = (bits(0) << 32 | bits(1)) * 0x9e3779b97f4a7c15ULL;
    if constexpr (N == 3)
      mixed = ((mixed ^ mixed >> 32) + bits(2)) * 0xd6e8feb86659fd93ULL;
    mixed = (mixed ^ mixed >> 32) * 0xff51afd7ed558ccdULL;
    mixed ^= mixed >> 32;
    sum_ += reversed ? 0 - mixed : mixed;
  }
  bool operator==(const chain_sum&) const = default;

private:
  std::uint64_t sum_ = 0;
};

} // namespace dovetail
