/// @file
/// Improves a partition by moving single nodes: balance first, then the cut.
///
/// Hill climbing after C. M. Fiduccia and R. M. Mattheyses, "A linear-time heuristic for improving network
/// partitions" (1982), with the k-way gains of B. W. Kernighan and S. Lin (1970).
#pragma once

#include "dovetail/partition/part_weights.hpp"

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
/// never worsens the cut once the limits hold. Deterministic.
class partition_refiner {
public:
  partition_refiner(const csr_graph& graph, std::span<local_id> part, std::vector<double> limits)
      : graph_(graph), part_(part), limits_(std::move(limits)),
        weights_(part_weights(graph, part, static_cast<int>(limits_.size()))), counts_(limits_.size(), 0),
        connection_(limits_.size(), 0.0) {
    for (const local_id p : part)
      ++counts_[index(p)];
  }

  void refine(int max_passes = 8) {
    balance();
    for (int pass = 0; pass < max_passes && improve_cut(); ++pass) {
    }
  }

  /// Moves nodes out of overweight parts, cheapest first, as long as this evens the weights out.
  void balance() {
    for (std::size_t p = 0; p < limits_.size(); ++p)
      if (weights_[p] > limits_[p]) {
        balance_all();
        return;
      }
  }

  /// One pass of moves, each node at most once, kept up to the best point. Returns whether the cut shrank.
  bool improve_cut() {
    std::vector<bool> locked(part_.size(), false);
    move_queue queue;
    for (std::size_t v = 0; v < part_.size(); ++v)
      offer(queue, static_cast<local_id>(v));
    std::vector<std::pair<local_id, local_id>> trail; // node, part it came from
    double gain = 0;
    double best_gain = 0;
    std::size_t best_length = 0;
    const std::size_t patience = 50 + part_.size() / 100;
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
      trail.push_back({v, part_[index(v)]});
      locked[index(v)] = true;
      apply(v, best.to);
      gain += best.gain;
      if (gain > best_gain + tolerance()) {
        best_gain = gain;
        best_length = trail.size();
      }
      for (const local_id w : graph_.row(v))
        if (!locked[index(w)])
          offer(queue, w);
    }
    for (std::size_t k = trail.size(); k > best_length; --k)
      apply(trail[k - 1].first, trail[k - 1].second);
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

  void apply(local_id v, local_id to) {
    const double w = graph_.node_weights[index(v)];
    const local_id from = part_[index(v)];
    weights_[index(from)] -= w;
    weights_[index(to)] += w;
    --counts_[index(from)];
    ++counts_[index(to)];
    part_[index(v)] = to;
  }

  void offer(move_queue& queue, local_id v) {
    const move best = best_move(v);
    if (best.to != no_id)
      queue.emplace(best.gain, -v);
  }

  /// Calls `consider(part, gain)` for every part next to v but its own.
  template <class Consider>
  void for_each_target(local_id v, const Consider& consider) {
    const local_id own = part_[index(v)];
    const auto row = graph_.row(v);
    const auto begin = index(graph_.offsets[index(v)]);
    touched_.clear();
    double inside = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const local_id p = part_[index(row[k])];
      const double weight = graph_.edge_weights[begin + k];
      if (p == own) {
        inside += weight;
        continue;
      }
      if (connection_[index(p)] == 0)
        touched_.push_back(p);
      connection_[index(p)] += weight;
    }
    for (const local_id p : touched_) {
      consider(p, connection_[index(p)] - inside);
      connection_[index(p)] = 0;
    }
  }

  /// The move of v with the largest gain that respects the limits; ties to the lighter part, then the first.
  move best_move(local_id v) {
    move best;
    if (counts_[index(part_[index(v)])] < 2)
      return best;
    const double w = graph_.node_weights[index(v)];
    for_each_target(v, [&](local_id p, double gain) {
      if (weights_[index(p)] + w > limits_[index(p)])
        return;
      const auto key = [&](local_id q, double g) { return std::tuple(-g, weights_[index(q)], q); };
      if (best.to == no_id || key(p, gain) < key(best.to, best.gain))
        best = {p, gain};
    });
    return best;
  }

  double relative_weight(local_id p) const { return weights_[index(p)] / limits_[index(p)]; }

  void balance_all() {
    // Every move makes a pair of parts more even, so this ends; the cap guards against rounding.
    for (std::size_t moves = 0; moves < 4 * part_.size(); ++moves) {
      local_id heaviest = 0;
      for (std::size_t p = 1; p < limits_.size(); ++p)
        if (relative_weight(static_cast<local_id>(p)) > relative_weight(heaviest))
          heaviest = static_cast<local_id>(p);
      if (relative_weight(heaviest) <= 1 || !shed_one(heaviest))
        return;
    }
  }

  /// Moves the cheapest node out of a part into one that stays relatively lighter.
  bool shed_one(local_id heavy) {
    if (counts_[index(heavy)] < 2)
      return false;
    local_id node = no_id;
    move best;
    for (std::size_t i = 0; i < part_.size(); ++i) {
      if (part_[i] != heavy || graph_.node_weights[i] <= 0)
        continue;
      const auto v = static_cast<local_id>(i);
      const double w = graph_.node_weights[i];
      for_each_target(v, [&](local_id p, double gain) {
        if ((weights_[index(p)] + w) / limits_[index(p)] >= relative_weight(heavy) * (1 - 1e-12))
          return;
        const auto key = [&](local_id q, double g) { return std::tuple(-g / w, weights_[index(q)], q); };
        if (node == no_id || key(p, gain) < std::tuple(-best.gain / graph_.node_weights[index(node)],
                                                       weights_[index(best.to)], best.to)) {
          node = v;
          best = {p, gain};
        }
      });
    }
    if (node == no_id)
      return false;
    apply(node, best.to);
    return true;
  }

  const csr_graph& graph_;
  std::span<local_id> part_;
  std::vector<double> limits_;
  std::vector<double> weights_;
  std::vector<local_id> counts_;
  std::vector<double> connection_; ///< scratch: weight of the edges from one node to each part
  std::vector<local_id> touched_;
};

/// Limits of equal parts: imbalance x average each.
inline std::vector<double> equal_limits(const csr_graph& graph, int parts, double imbalance) {
  const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
  return std::vector<double>(static_cast<std::size_t>(parts), imbalance * total / parts);
}

} // namespace dovetail
