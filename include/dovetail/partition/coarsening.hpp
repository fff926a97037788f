/// @file
/// Halves a graph by matching along heavy edges, so that cuts of the small graph are cuts of the large one.
#pragma once

#include "dovetail/graph/csr_graph.hpp"

#include <cstdint>
#include <vector>

namespace dovetail {

/// A smaller graph and the node of it that each node of the larger one went to.
struct coarsened_graph {
  csr_graph graph;               ///< the smaller graph
  std::vector<local_id> node_of; ///< by node of the larger graph
};

/// Matches each node, in an order that `seed` determines, with the free neighbour of heaviest edge; pairs
/// heavier than `max_weight` are not made. Linear but for the contraction.
coarsened_graph match_heavy_edges(const csr_graph& graph, double max_weight, std::uint64_t seed);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/coarsening.ipp"
#endif
