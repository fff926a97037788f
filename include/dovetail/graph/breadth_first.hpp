/// @file
/// Breadth-first order over any adjacency, without Boost.Graph (whose headers cost as much to parse as a
/// tenth of this library).
#pragma once

#include "dovetail/core/ids.hpp"

#include <cstddef>
#include <vector>

namespace dovetail {

/// The nodes reached from `start`, nearest first. `visit_neighbours(node, visit)` calls `visit(neighbour)`
/// for each neighbour of a node, in the order that ties are to be broken by. Linear.
template <class Node, class VisitNeighbours>
std::vector<Node> breadth_first_order(std::size_t node_count, Node start,
                                      const VisitNeighbours& visit_neighbours) {
  std::vector<bool> seen(node_count, false);
  std::vector<Node> order{start};
  seen[static_cast<std::size_t>(start)] = true;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Node node = order[k]; // `order` grows below
    visit_neighbours(node, [&](Node next) {
      if (seen[static_cast<std::size_t>(next)])
        return;
      seen[static_cast<std::size_t>(next)] = true;
      order.push_back(next);
    });
  }
  return order;
}

} // namespace dovetail
