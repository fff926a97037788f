/// @file
/// The order in which points are inserted into a Delaunay triangulation.
#pragma once

#include "dovetail/core/hilbert_curve.hpp"
#include "dovetail/core/scattered.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/triangulation/space.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The box of points, lower and upper corner.
template <int D>
std::array<std::array<double, static_cast<std::size_t>(D)>, 2> box_of(std::span<const point_of<D>> points) {
  constexpr auto axes = static_cast<std::size_t>(D);
  std::array<std::array<double, axes>, 2> box{};
  if (!points.empty())
    box = {coordinates(points[0]), coordinates(points[0])};
  for (const auto& point : points)
    for (std::size_t k = 0; k < axes; ++k) {
      const double value = coordinates(point)[k];
      box[0][k] = value < box[0][k] ? value : box[0][k];
      box[1][k] = value > box[1][k] ? value : box[1][k];
    }
  return box;
}

/// Rounds that grow by 2^D each, drawn at random, and in each round along a Hilbert curve: expected times
/// stay those of a random order, and what is inserted one after the other is close in space (N. Amenta, S.
/// Choi, G. Rote, "Incremental constructions con BRIO", doi 10.1145/777792.777824). `points` lie in `box`.
/// O(n log n).
template <int D>
std::vector<local_id>
insertion_order(std::span<const point_of<D>> points,
                const std::array<std::array<double, static_cast<std::size_t>(D)>, 2>& box) {
  constexpr auto axes = static_cast<std::size_t>(D);
  constexpr int curve_bits = D == 2 ? 29 : 19; // with the round, which is below 2^5, in 63 bits
  constexpr double cells = (1U << unsigned{curve_bits}) - 1;
  constexpr std::uint64_t most_rounds = 31;
  constexpr std::size_t least_round = 64; // points; rounds that are smaller are of no use
  std::array<double, axes> per_width{};
  double widest = 0;
  for (std::size_t k = 0; k < axes; ++k)
    widest = std::max(widest, box[1][k] - box[0][k]);
  per_width.fill(widest > 0 ? cells / widest : 0);
  std::uint64_t rounds = 0;
  for (std::size_t n = points.size(); n > least_round && rounds < most_rounds; n >>= unsigned{D})
    ++rounds;

  std::vector<std::pair<std::uint64_t, local_id>> keyed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<std::uint32_t, axes> cell{};
    const auto p = coordinates(points[i]);
    for (std::size_t k = 0; k < axes; ++k)
      cell[k] = static_cast<std::uint32_t>((p[k] - box[0][k]) * per_width[k]);
    const auto drawn = static_cast<std::uint64_t>(std::countr_zero(scattered(i) | (1ULL << 63U))) / D;
    const std::uint64_t round = rounds - std::min(drawn, rounds);
    keyed[i] = {round << static_cast<unsigned>(D * curve_bits) | hilbert_place<axes>(cell, curve_bits),
                static_cast<local_id>(i)};
  }
  sort_all(keyed);
  std::vector<local_id> order(points.size());
  for (std::size_t i = 0; i < keyed.size(); ++i)
    order[i] = keyed[i].second;
  return order;
}

} // namespace dovetail::detail
