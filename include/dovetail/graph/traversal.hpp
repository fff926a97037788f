/// @file
/// Walks that need no more of a graph than Boost.Graph's concepts.
#pragma once

#include "dovetail/graph/concepts.hpp"

#include <cstddef>
#include <vector>

namespace dovetail {

/// The vertices reached from `start`, nearest first, in the order of adjacency. Vertices must be whole
/// numbers below num_vertices(g). Linear.
template <class G>
  requires adjacency_graph<G> && vertex_list_graph<G> std::vector<vertex_of<G>>
  breadth_first_order(const G& g, vertex_of<G> start) {
    std::vector<bool> seen(static_cast<std::size_t>(num_vertices(g)), false);
    std::vector<vertex_of<G>> order{start};
    seen[static_cast<std::size_t>(start)] = true;
    for (std::size_t k = 0; k < order.size(); ++k)
      for (auto [w, end] = adjacent_vertices(order[k], g); w != end; ++w)
        if (!seen[static_cast<std::size_t>(*w)]) {
          seen[static_cast<std::size_t>(*w)] = true;
          order.push_back(*w);
        }
    return order;
  }

} // namespace dovetail
