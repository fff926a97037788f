/// @file
/// What `balancing.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/balancing.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE movable_parts::movable_parts(const csr_graph& graph, std::span<local_id> part,
                                             std::vector<double> limits)
    : graph_(graph), part_(part), limits_(std::move(limits)),
      weights_(part_weights(graph, part, static_cast<int>(limits_.size()))), counts_(limits_.size(), 0),
      gains_(graph, part, limits_.size()) {
  for (const local_id p : part)
    ++counts_[p];
}

DOVETAIL_INLINE void movable_parts::move(local_id node, local_id to) {
  local_id& from = part_[node];
  weights_[from] -= weight_of_node(node);
  weights_[to] += weight_of_node(node);
  --counts_[from];
  ++counts_[to];
  from = to;
}

DOVETAIL_INLINE void part_balancer::run() {
  bool is_balanced = true;
  for (local_id p = 0; p < static_cast<local_id>(parts_.part_count()); ++p)
    is_balanced = is_balanced && !is_overweight(p);
  if (is_balanced) // always so in a graph without weight, where nothing is relative
    return;
  for (local_id p = 0; p < static_cast<local_id>(parts_.part_count()); ++p)
    by_weight_.insert(standing_of(p));
  exits_.resize(parts_.part_count());
  for (std::size_t v = 0; v < parts_.node_count(); ++v)
    offer(static_cast<local_id>(v));
  // Every move makes a pair of parts more even, so this ends; the cap guards against rounding.
  for (std::size_t moves = 0; moves < 4 * parts_.node_count(); ++moves)
    if (!is_overweight(heaviest()) || !shed_one(heaviest()))
      return;
}

DOVETAIL_INLINE void part_balancer::offer(local_id node) {
  const double w = parts_.weight_of_node(node);
  if (w <= 0)
    return;
  auto& exits = exits_[parts_.part_of(node)];
  parts_.gains().for_each_target(
      node, [&](local_id to, double gain) { exits[to].by_gain.emplace(gain / w, -node); });
}

DOVETAIL_INLINE std::optional<double> part_balancer::gain_of(local_id node, local_id from, local_id to) {
  std::optional<double> found;
  if (parts_.part_of(node) == from)
    parts_.gains().for_each_target(node, [&](local_id p, double gain) {
      if (p == to)
        found = gain / parts_.weight_of_node(node);
    });
  return found;
}

DOVETAIL_INLINE part_balancer::move part_balancer::best_through(exit& way, local_id from, local_id to) {
  for (; !way.too_heavy.empty() && fits(-way.too_heavy.top().second, from, to); way.too_heavy.pop())
    if (const auto gain = gain_of(-way.too_heavy.top().second, from, to))
      way.by_gain.emplace(*gain, way.too_heavy.top().second);
  for (; !way.by_gain.empty(); way.by_gain.pop()) {
    const auto [gain, negated] = way.by_gain.top();
    if (gain_of(-negated, from, to) != gain)
      continue;
    if (fits(-negated, from, to))
      return {-negated, to, gain};
    way.too_heavy.emplace(parts_.weight_of_node(-negated), negated);
  }
  return {};
}

DOVETAIL_INLINE bool part_balancer::shed_one(local_id from) {
  if (parts_.nodes_in(from) < 2)
    return false;
  move best;
  for (auto& [to, way] : exits_[from]) {
    const move candidate = best_through(way, from, to);
    const auto key = [&](const move& m) { return std::tuple(-m.gain, parts_.weight(m.to), m.to); };
    if (candidate.node != no_id && (best.node == no_id || key(candidate) < key(best)))
      best = candidate;
  }
  if (best.node == no_id)
    return false;
  by_weight_.erase(standing_of(from));
  by_weight_.erase(standing_of(best.to));
  parts_.move(best.node, best.to);
  by_weight_.insert(standing_of(from));
  by_weight_.insert(standing_of(best.to));
  offer(best.node);
  for (const local_id other : parts_.graph().row(best.node))
    offer(other);
  return true;
}

} // namespace dovetail
