/// @file
/// Breadth-first order over any graph.
#pragma once

#include "dovetail/graph/concepts.hpp"

#include <cstddef>
#include <vector>

namespace dovetail {

/// The nodes reached from `start`, nearest first, in the order of neighbours. Linear.
template <graph G>
std::vector<local_id> breadth_first_order(const G& graph, local_id start) {
  std::vector<bool> seen(static_cast<std::size_t>(graph.node_count()), false);
  std::vector<local_id> order{start};
  seen[start] = true;
  for (std::size_t k = 0; k < order.size(); ++k)
    graph.for_each_neighbour(order[k], [&](local_id next) {
      if (seen[next])
        return;
      seen[next] = true;
      order.push_back(next);
    });
  return order;
}

} // namespace dovetail
