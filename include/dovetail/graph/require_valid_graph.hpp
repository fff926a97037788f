/// @file
/// The check at the entry of partitioners: is this graph what `csr_graph` says?
#pragma once

#include "dovetail/graph/csr_graph.hpp"

namespace dovetail {

/// Throws `partition_error` that names the node, and not who is to partition the graph, unless sizes fit,
/// neighbours are other nodes, weights are finite and not negative, and every edge is in the rows of both of
/// its ends with the same weight, to a part in 10^9 of all weights. Linear, some nanoseconds per entry.
/// \param graph as partitioners take it
void require_valid_graph(const csr_graph& graph);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/graph/require_valid_graph.ipp"
#endif
