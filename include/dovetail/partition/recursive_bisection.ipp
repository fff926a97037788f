/// @file
/// What `recursive_bisection.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/partition/recursive_bisection.hpp"

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<local_id> cut_order(std::span<const local_id> order,
                                                std::span<const double> node_weights,
                                                std::span<const int> shares) {
  double total = 0;
  for (const local_id v : order)
    total += node_weights[v];
  const int all_shares = std::accumulate(shares.begin(), shares.end(), 0);
  std::vector<local_id> run(node_weights.size(), 0);
  std::size_t at = 0;
  double before = 0; // weight of the nodes before `at`
  int shares_before = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const auto least_end = at + static_cast<std::size_t>(shares[k]);
    shares_before += shares[k];
    const std::size_t largest_end = order.size() - static_cast<std::size_t>(all_shares - shares_before);
    const double target = total * shares_before / all_shares;
    while (at < largest_end) {
      const double w = node_weights[order[at]];
      const bool nearer_without = before + w - target > target - before;
      if (at >= least_end && k + 1 < shares.size() && nearer_without)
        break;
      run[order[at++]] = static_cast<local_id>(k);
      before += w;
    }
  }
  return run;
}

DOVETAIL_INLINE std::vector<local_id> order_by(std::span<const double> keys) {
  std::vector<local_id> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  stable_sort_all(order, [&](local_id a, local_id b) { return keys[a] < keys[b]; });
  return order;
}

} // namespace dovetail
