/// @file
/// Sums of oriented simplices, to compare chains without sorting them.
#pragma once

#include "dovetail/core/scattered.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace dovetail {

/// Oriented simplices added up: one that is passed in both directions adds nothing. Sums of equal chains are
/// equal; those of different ones are so by a chance of 2^-64.
class chain_sum {
public:
  /// Adds one oriented edge or triangle.
  template <std::size_t N>
  void add(const std::array<local_id, N>& side) {
    static_assert(N == 2 || N == 3);
    std::uint64_t vertices = 0;
    for (const local_id v : side)
      vertices += scattered(v);
    add(vertices, is_reversed(side));
  }
  /// Adds the sides of an element, oriented outwards.
  template <std::size_t N>
  void add_sides_of(const std::array<local_id, N>& element) {
    constexpr int dimension = static_cast<int>(N) - 1;
    std::array<std::uint64_t, N> numbers;
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < N; ++k)
      all += numbers[k] = scattered(element[k]);
    for (std::size_t i = 0; i < N; ++i) {
      std::array<local_id, N - 1> side;
      for (std::size_t k = 0; k + 1 < N; ++k)
        side[k] = element[numbering::sides<dimension>[i][k]];
      add(all - numbers[i], is_reversed(side));
    }
  }
  bool operator==(const chain_sum&) const = default;

private:
  static std::uint64_t scattered(local_id v) { return detail::scattered(static_cast<std::uint32_t>(v)); }
  /// Whether it is an odd permutation of its vertices in growing order. Without branches: they could not be
  /// foretold.
  static bool is_reversed(const std::array<local_id, 2>& side) { return side[0] > side[1]; }
  static bool is_reversed(const std::array<local_id, 3>& side) {
    return !((side[0] > side[1]) ^ (side[1] > side[2]) ^ (side[2] > side[0]));
  }
  /// `vertices`: the sum of their scattered numbers, which is the same in any order.
  void add(std::uint64_t vertices, bool reversed) {
    const std::uint64_t number = detail::scattered(vertices), sign = reversed ? 1 : 0;
    sum_ += (number ^ (0 - sign)) + sign;
  }

  std::uint64_t sum_ = 0;
};

} // namespace dovetail
