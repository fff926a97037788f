/// @file
/// By how much the cut shrinks when a node goes to another part.
#pragma once

#include "dovetail/graph/csr_graph.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// The gains of single nodes, after B. W. Kernighan and S. Lin (1970), for any number of parts. The graph and
/// the parts must outlive it; parts may change between calls.
class move_gains {
public:
  move_gains(const csr_graph& graph, std::span<const local_id> part, std::size_t parts)
      : graph_(graph), part_(part), connection_(parts, unseen) {}
  move_gains(csr_graph&&, std::span<const local_id>, std::size_t) = delete; // it would be gone

  /// Calls `consider(part, gain)` for every part next to a node but its own. Linear in the node's edges.
  template <class Consider>
  void for_each_target(local_id node, const Consider& consider) {
    const local_id own = part_[node];
    const auto row = graph_.row(node);
    const auto begin = static_cast<std::size_t>(graph_.offsets[node]);
    touched_.clear();
    double inside = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const local_id p = part_[row[k]];
      const double weight = graph_.edge_weights[begin + k];
      if (p == own) {
        inside += weight;
        continue;
      }
      double& connection = connection_[p];
      if (connection == unseen) {
        touched_.push_back(p);
        connection = 0;
      }
      connection += weight;
    }
    for (const local_id p : touched_) {
      double& connection = connection_[p];
      consider(p, connection - inside);
      connection = unseen;
    }
  }

private:
  static constexpr double unseen = -1; ///< an edge may weigh nothing

  const csr_graph& graph_;
  std::span<const local_id> part_;
  std::vector<double> connection_; ///< scratch, per part: weight of the edges to it from the node at hand
  std::vector<local_id> touched_;
};

} // namespace dovetail
