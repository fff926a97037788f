/// @file
/// Improves a partition by moving single nodes: balance first, then the cut.
///
/// Hill climbing after C. M. Fiduccia and R. M. Mattheyses, "A linear-time heuristic for improving network
/// partitions" (1982), with the k-way gains of B. W. Kernighan and S. Lin (1970).
#pragma once

#include "dovetail/partition/balancing.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// Refines `part` in place; `limits[p]` is the weight that part p should not exceed. Never empties a part,
/// never worsens the cut once the limits hold. Deterministic. About n log n per pass.
class partition_refiner {
public:
  partition_refiner(const csr_graph& graph, std::span<local_id> part, std::vector<double> limits)
      : parts_(graph, part, std::move(limits)) {}
  partition_refiner(csr_graph&&, std::span<local_id>, std::vector<double>) = delete; // it would be gone

  /// Balances, then lowers the cut until a pass gains nothing or `max_passes` are done.
  void refine(int max_passes = 8) {
    part_balancer(parts_).run();
    for (int pass = 0; pass < max_passes && improve_cut(); ++pass) {
    }
  }

  /// One pass of moves, each node at most once, kept up to the best point. Returns whether the cut shrank.
  bool improve_cut();

private:
  struct move {
    local_id to = no_id;
    double gain = 0;
  };
  using move_queue = std::priority_queue<std::pair<double, local_id>>; // gain, then the smaller node

  /// Gains are sums of weights; differences below this are rounding.
  static constexpr double tolerance() { return 1e-9; }

  void offer(move_queue& queue, local_id v) {
    const move best = best_move(v);
    if (best.to != no_id)
      queue.emplace(best.gain, -v);
  }

  /// The move of v with the largest gain that respects the limits; ties to the lighter part, then the first.
  move best_move(local_id v);

  movable_parts parts_;
};

/// Limits of equal parts: imbalance x average each.
inline std::vector<double> equal_limits(const csr_graph& graph, int parts, double imbalance) {
  const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
  return std::vector<double>(static_cast<std::size_t>(parts), imbalance * total / parts);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/refinement.ipp"
#endif
