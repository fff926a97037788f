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
#include <queue>
#include <span>
#include <tuple>
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
  bool improve_cut() {
    std::vector<bool> locked(parts_.node_count(), false);
    move_queue queue;
    for (std::size_t v = 0; v < parts_.node_count(); ++v)
      offer(queue, static_cast<local_id>(v));
    std::vector<std::pair<local_id, local_id>> trail; // node, part it came from
    double gain = 0;
    double best_gain = 0;
    std::size_t best_length = 0;
    const std::size_t patience = 50 + parts_.node_count() / 100;
    while (!queue.empty() && trail.size() < best_length + patience) {
      const auto [promised, negated_node] = queue.top();
      const local_id v = -negated_node;
      queue.pop();
      if (locked[index(v)])
        continue;
      const move best = best_move(v);
      if (best.to == no_id)
        continue;
      if (best.gain < promised) { // an older state of the node
        queue.emplace(best.gain, negated_node);
        continue;
      }
      trail.push_back({v, parts_.part_of(v)});
      locked[index(v)] = true;
      parts_.move(v, best.to);
      gain += best.gain;
      if (gain > best_gain + tolerance()) {
        best_gain = gain;
        best_length = trail.size();
      }
      for (const local_id w : parts_.graph().row(v))
        if (!locked[index(w)])
          offer(queue, w);
    }
    for (std::size_t k = trail.size(); k > best_length; --k)
      parts_.move(trail[k - 1].first, trail[k - 1].second);
    return best_length > 0;
  }

private:
  struct move {
    local_id to = no_id;
    double gain = 0;
  };
  using move_queue = std::priority_queue<std::pair<double, local_id>>; // gain, then the smaller node

  template <class Id>
  static std::size_t index(Id id) {
    return static_cast<std::size_t>(id);
  }
  /// Gains are sums of weights; differences below this are rounding.
  static constexpr double tolerance() { return 1e-9; }

  void offer(move_queue& queue, local_id v) {
    const move best = best_move(v);
    if (best.to != no_id)
      queue.emplace(best.gain, -v);
  }

  /// The move of v with the largest gain that respects the limits; ties to the lighter part, then the first.
  move best_move(local_id v) {
    move best;
    if (parts_.nodes_in(parts_.part_of(v)) < 2)
      return best;
    parts_.gains().for_each_target(v, [&](local_id p, double gain) {
      if (parts_.weight(p) + parts_.weight_of_node(v) > parts_.limit(p))
        return;
      const auto key = [&](local_id q, double g) { return std::tuple(-g, parts_.weight(q), q); };
      if (best.to == no_id || key(p, gain) < key(best.to, best.gain))
        best = {p, gain};
    });
    return best;
  }

  movable_parts parts_;
};

/// Limits of equal parts: imbalance x average each.
inline std::vector<double> equal_limits(const csr_graph& graph, int parts, double imbalance) {
  const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
  return std::vector<double>(static_cast<std::size_t>(parts), imbalance * total / parts);
}

} // namespace dovetail
