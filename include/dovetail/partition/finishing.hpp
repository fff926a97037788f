/// @file
/// What every partitioner does last, so that all of them keep the promises of the role.
#pragma once

#include "dovetail/graph/csr_graph.hpp"

#include <span>

namespace dovetail::detail {

/// Throws `partition_error` for an imbalance that no partition has.
void require_imbalance(double imbalance);
void require_coarse_nodes(int per_part);

/// The weight that no part may exceed: the limit asked for, or what the heaviest node leaves possible.
double allowed_part_weight(const csr_graph& graph, int parts, double imbalance);

/// Moves nodes from the heaviest to the lightest part, wherever they are, until no part exceeds what is
/// allowed: the last resort for graphs whose edges lead to no lighter part. Always succeeds: a lightest part
/// is not above the average, so with one node more it is not above what is allowed.
void level_parts(const csr_graph& graph, std::span<local_id> part, int parts, double imbalance);

/// Fills empty parts, meets the weight limit, and improves the cut by at most `passes` passes of local
/// refinement (0: none).
void finish_partition(const csr_graph& graph, std::span<local_id> part, int parts, double imbalance,
                      int passes);

} // namespace dovetail::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/finishing.ipp"
#endif
