/// @file
/// What the pipeline asks of a partitioner.
#pragma once

#include "dovetail/graph/csr_graph.hpp"

#include <concepts>
#include <vector>

namespace dovetail {

/// The role `graph_partitioner`: split a weighted graph into balanced parts with a small cut.
///
/// Valid expression for `const P& p`, `const csr_graph& g`, `int parts`: `p(g, parts)` ->
/// std::vector<local_id>, the part in [0, parts) of every node. Every `weighted_graph` converts to a
/// `csr_graph`, so a model that takes `const csr_graph&` takes them all.
///
/// Semantics: every part is non-empty when the graph has at least `parts` nodes; the heaviest part weighs
/// at most `imbalance` times the average, or as much as the average and the heaviest node together;
/// deterministic for the model's seed.
///
/// Complexity: at most n log n in the nodes and edges, times log(parts) by bisection.
///
/// Failure: throws `partition_error`. So does `checked_partition`, by which stages call it, for an invalid
/// graph (`require_valid_graph`) and for a result of another length, with parts out of range or with an empty
/// one.
///
/// Models: metis, scotch, spectral, greedy; recursive_coordinate, inertial, space_filling_curve, which need
/// the positions of the nodes.
template <class P>
concept graph_partitioner = std::copy_constructible<P> &&
    requires(const P& p, const csr_graph& g, int parts) {
  { p(g, parts) } -> std::same_as<std::vector<local_id>>;
};

} // namespace dovetail
