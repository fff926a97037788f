/// @file
/// Walks that need no more of a graph than Boost.Graph's concepts.
#pragma once

#include "dovetail/graph/breadth_first.hpp"
#include "dovetail/graph/concepts.hpp"

#include <cstddef>
#include <vector>

namespace dovetail {

/// The vertices reached from `start`, nearest first, in the order of adjacency. Vertices must be whole
/// numbers below num_vertices(g). Linear.
template <class G>
  requires adjacency_graph<G> && vertex_list_graph<G> std::vector<vertex_of<G>>
  breadth_first_order(const G& g, vertex_of<G> start) {
    return breadth_first_order(static_cast<std::size_t>(num_vertices(g)), start,
                               [&g](vertex_of<G> vertex, const auto& visit) {
                                 for (auto [w, end] = adjacent_vertices(vertex, g); w != end; ++w)
                                   visit(*w);
                               });
  }

} // namespace dovetail
