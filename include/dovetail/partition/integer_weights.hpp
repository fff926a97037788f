/// @file
/// Real weights for partitioning libraries that count in integers.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/graph/csr_graph.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace dovetail::detail {

/// Integers of at least 1 in proportion to `weights`; the weights themselves when these are small integers.
/// Libraries add weights up in `Int`, so the sum stays below an eighth of its range, with room for internal
/// multiples. Throws `partition_error` when even ones do not fit.
template <class Int>
std::vector<Int> integer_weights(std::span<const double> weights, const char* library, const char* what) {
  constexpr double largest_sum = static_cast<double>(std::numeric_limits<Int>::max()) / 8.0;
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const bool as_they_are = sum <= largest_sum && std::all_of(weights.begin(), weights.end(), [](double w) {
                             return w >= 1 && w == std::floor(w);
                           });
  const auto count = static_cast<double>(weights.size());
  if (count > largest_sum)
    throw partition_error(std::string(library) + " counts in integers too small for " +
                          std::to_string(weights.size()) + " " + what +
                          "; use a coarser mesh or another partitioner");
  // Rounding up to 1 adds at most `count`, so scale to what is left.
  const double scale = as_they_are ? 1.0 : sum > 0 ? (largest_sum - count) / sum : 0.0;
  std::vector<Int> scaled(weights.size());
  for (std::size_t k = 0; k < weights.size(); ++k)
    scaled[k] = std::max(Int{1}, static_cast<Int>(std::lround(weights[k] * scale)));
  return scaled;
}

/// Few nodes per part, or one that fills a part, or no edges: graphs for which multilevel libraries are not
/// made.
inline bool is_too_small_for_multilevel(const csr_graph& graph, int parts) {
  const auto& weights = graph.node_weights;
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  return graph.node_count() < 3 * parts || graph.neighbours.empty() ||
         *std::max_element(weights.begin(), weights.end()) >= total / parts;
}

} // namespace dovetail::detail
