/// @file
/// Real weights for partitioning libraries that count in integers.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/graph/csr_graph.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dovetail::detail {

/// Of all weights of a kind, wherever they are: what their scale and some decisions hang on.
struct weight_sums {
  double count = 0;
  double sum = 0;
  double largest = 0;
  bool are_integers = true; ///< of at least 1

  void add(double w) { add({1, w, w, w >= 1 && w == std::floor(w)}); }
  void add(const weight_sums& more);
};

weight_sums sums_of(std::span<const double> weights);

/// Integers of at least 1 in proportion to `weights`, which are some of those in `all`; the weights
/// themselves when all are small integers. Libraries add weights up in `Int`, so the sum stays below an
/// eighth of its range, with room for internal multiples. Throws `partition_error` when even ones do not fit.
template <class Int>
std::vector<Int> integer_weights(std::span<const double> weights, const weight_sums& all, const char* library,
                                 const char* what) {
  constexpr double largest_sum = static_cast<double>(std::numeric_limits<Int>::max()) / 8.0;
  if (all.count > largest_sum)
    throw partition_error(std::string(library) + " counts in integers too small for " +
                          std::to_string(static_cast<std::int64_t>(all.count)) + " " + what +
                          "; use a coarser mesh or another partitioner");
  // Rounding up to 1 adds at most `count`, so scale to what is left.
  const bool as_they_are = all.sum <= largest_sum && all.are_integers;
  const double scale = as_they_are ? 1.0 : all.sum > 0 ? (largest_sum - all.count) / all.sum : 0.0;
  std::vector<Int> scaled(weights.size());
  for (std::size_t k = 0; k < weights.size(); ++k)
    scaled[k] = std::max(Int{1}, static_cast<Int>(std::lround(weights[k] * scale)));
  return scaled;
}

template <class Int>
std::vector<Int> integer_weights(std::span<const double> weights, const char* library, const char* what) {
  return integer_weights<Int>(weights, sums_of(weights), library, what);
}

/// Few nodes per part, or one that fills a part, or no edges: graphs for which multilevel libraries are not
/// made.
inline bool is_too_small_for_multilevel(const weight_sums& nodes, double edges, int parts) {
  return nodes.count < 3.0 * parts || edges == 0 || nodes.largest >= nodes.sum / parts;
}
inline bool is_too_small_for_multilevel(const csr_graph& graph, int parts) {
  return is_too_small_for_multilevel(sums_of(graph.node_weights),
                                     static_cast<double>(graph.neighbours.size()), parts);
}

} // namespace dovetail::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/integer_weights.ipp"
#endif
