/// @file
/// What `by_pieces.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/distributed/by_pieces.hpp"
#include "dovetail/partition/connectivity.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <vector>

namespace dovetail {

namespace detail {

class connected_leveller {
public:
  connected_leveller(const csr_graph& graph, std::vector<local_id>& part, int parts, double imbalance)
      : graph_(graph), part_(part), weights_(part_weights(graph, part, parts)),
        members_(static_cast<std::size_t>(parts)) {
    allowed_ = imbalance * std::accumulate(weights_.begin(), weights_.end(), 0.0) / parts;
    for (std::size_t v = 0; v < part.size(); ++v)
      members_[part[v]].push_back(static_cast<local_id>(v));
  }

  void run() {
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<local_id> order(weights_.size());
      std::iota(order.begin(), order.end(), local_id{0});
      stable_sort_all(order, [&](local_id a, local_id b) { return weights_[a] > weights_[b]; });
      if (weights_[order.front()] <= allowed_)
        return;
      for (std::size_t i = 0; !changed && i < order.size(); ++i)
        changed = relieve(order[i]);
    }
  }

private:
  struct step {
    double gain = 0; ///< half of what the sum of squares loses
    local_id out = no_id;
    local_id to = no_id;
    local_id back = no_id; ///< what comes in exchange, or no_id
  };
  double weight(local_id node) const { return graph_.node_weights[node]; }

  bool is_beside(local_id node, local_id part, local_id without = no_id) const {
    const auto row = graph_.row(node);
    return std::any_of(row.begin(), row.end(), [&](local_id w) { return w != without && part_[w] == part; });
  }

  std::size_t components_of(std::vector<local_id> nodes) const {
    std::size_t components = 0;
    for (std::vector<local_id> reached; !nodes.empty(); ++components) {
      reached = {nodes.back()};
      nodes.pop_back();
      for (std::size_t k = 0; k < reached.size(); ++k)
        for (const local_id w : graph_.row(reached[k]))
          if (std::erase(nodes, w) > 0)
            reached.push_back(w);
    }
    return components;
  }
  /// Whether a part is left with a node, and no more in pieces, when `out` has gone and `in` has come.
  bool stays_whole(local_id part, local_id out, local_id in) const {
    auto nodes = members_[part];
    const std::size_t before = components_of(nodes);
    std::erase(nodes, out);
    if (in != no_id)
      nodes.push_back(in);
    return !nodes.empty() && components_of(nodes) <= before;
  }
  bool is_possible(const step& s, local_id from) const {
    return stays_whole(from, s.out, s.back) && stays_whole(s.to, s.back, s.out);
  }

  /// Makes the step out of a part that evens out most; false when there is none.
  bool relieve(local_id from) {
    std::vector<step> steps;
    const auto offer = [&](local_id out, local_id to, local_id back) {
      const double by = weight(out) - (back == no_id ? 0 : weight(back));
      const double gain = by * (weights_[from] - weights_[to] - by);
      if (by > 0 && gain > 1e-9 * allowed_ * allowed_)
        steps.push_back({gain, out, to, back});
    };
    std::vector<local_id> targets;
    for (const local_id v : members_[from]) {
      targets.clear();
      for (const local_id w : graph_.row(v))
        if (const local_id p = part_[w]; p != from && weights_[p] < weights_[from])
          targets.push_back(p);
      sort_unique(targets);
      for (const local_id to : targets) {
        offer(v, to, no_id);
        for (const local_id back : members_[to])
          if (is_beside(back, from, v))
            offer(v, to, back);
      }
    }
    sort_all(steps, [](const step& a, const step& b) {
      return std::tuple(-a.gain, a.out, a.to, a.back) < std::tuple(-b.gain, b.out, b.to, b.back);
    });
    for (const step& s : steps)
      if (is_possible(s, from)) {
        move(s.out, from, s.to);
        if (s.back != no_id)
          move(s.back, s.to, from);
        return true;
      }
    return false;
  }

  void move(local_id node, local_id from, local_id to) {
    std::erase(members_[from], node);
    members_[to].push_back(node);
    weights_[from] -= weight(node);
    weights_[to] += weight(node);
    part_[node] = to;
  }

  const csr_graph& graph_;
  std::vector<local_id>& part_;
  std::vector<double> weights_;
  std::vector<std::vector<local_id>> members_;
  double allowed_ = 0;
};

} // namespace detail

DOVETAIL_INLINE void even_out_connected(const csr_graph& graph, std::vector<local_id>& part, int parts,
                                        double imbalance) {
  join_stray_components(graph, part, parts);
  detail::connected_leveller(graph, part, parts, imbalance).run();
}

} // namespace dovetail
