/// @file
/// Evens out the weights of parts by moving single nodes, cheapest first.
#pragma once

#include "dovetail/partition/move_gains.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// A partition with limits of its parts' weights, whose nodes are moved one by one.
class movable_parts {
public:
  movable_parts(const csr_graph& graph, std::span<local_id> part, std::vector<double> limits);
  movable_parts(csr_graph&&, std::span<local_id>, std::vector<double>) = delete; // it would be gone

  const csr_graph& graph() const { return graph_; }         ///< the graph that is partitioned
  std::size_t node_count() const { return part_.size(); }   ///< nodes of the graph
  std::size_t part_count() const { return limits_.size(); } ///< how many parts there are
  /// The weight of one node.
  double weight_of_node(local_id node) const { return graph_.node_weights[node]; }
  local_id part_of(local_id node) const { return part_[node]; } ///< the part that a node is in now
  /// The sum of the weights of a part's nodes.
  double weight(local_id part) const { return weights_[part]; }
  /// What the weight of a part should not exceed.
  double limit(local_id part) const { return limits_[part]; }
  local_id nodes_in(local_id part) const { return counts_[part]; } ///< how many nodes a part has
  /// Weight over limit: above 1 it is overweight.
  double relative_weight(local_id part) const { return weight(part) / limit(part); }
  move_gains& gains() { return gains_; } ///< what moving nodes would gain

  /// Gives a node to another part.
  void move(local_id node, local_id to);

private:
  const csr_graph& graph_;
  std::span<local_id> part_;
  std::vector<double> limits_;
  std::vector<double> weights_;
  std::vector<local_id> counts_;
  move_gains gains_;
};

/// Takes nodes out of overweight parts, the relatively heaviest first: always the one that costs least cut
/// per weight, into a part that stays relatively lighter; ties go to the lighter part, then the first one,
/// then the first node. Never empties a part. About n log n: every move asks only the neighbours of the node.
class part_balancer {
public:
  explicit part_balancer(movable_parts& parts) : parts_(parts) {}

  /// Moves nodes until no part is overweight, or none may be moved.
  void run();

private:
  using offered_node = std::pair<double, local_id>; ///< key, negated node
  /// The nodes of one part that could go to a certain other.
  struct exit {
    std::priority_queue<offered_node> by_gain; ///< gain per weight, then the smaller node
    /// Those that are too heavy for the other part at present, the lightest first.
    std::priority_queue<offered_node, std::vector<offered_node>, std::greater<>> too_heavy;
  };
  struct move {
    local_id node = no_id;
    local_id to = no_id;
    double gain = 0; ///< per weight
  };

  std::pair<double, local_id> standing_of(local_id part) const {
    return {-parts_.relative_weight(part), part};
  }
  local_id heaviest() const { return by_weight_.begin()->second; }
  bool is_overweight(local_id part) const { return parts_.weight(part) > parts_.limit(part); }

  /// Enters a node with all its gains; entries of former gains are passed over when they come up.
  void offer(local_id node);

  /// The gain per weight of a move from one part to another; none when the node is not there, or not beside.
  std::optional<double> gain_of(local_id node, local_id from, local_id to);

  bool fits(local_id node, local_id from, local_id to) const {
    return (parts_.weight(to) + parts_.weight_of_node(node)) / parts_.limit(to) <
           parts_.relative_weight(from) * (1 - 1e-12);
  }

  /// The best move from one part to another.
  move best_through(exit& way, local_id from, local_id to);

  bool shed_one(local_id from);

  movable_parts& parts_;
  std::set<std::pair<double, local_id>> by_weight_; ///< negated relative weight, part
  std::vector<std::map<local_id, exit>> exits_;     ///< per part, by the part they lead to
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/balancing.ipp"
#endif
