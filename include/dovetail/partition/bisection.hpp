/// @file
/// Bisection by greedy graph growing: the start of the multilevel partitioner.
#pragma once

#include "dovetail/graph/csr_graph.hpp"

#include <span>
#include <vector>

namespace dovetail {
namespace detail {

/// The best of several grown and refined bisections; part 0 should weigh `fraction` of the whole.
std::vector<local_id> bisect(const csr_graph& graph, double fraction, double imbalance);

} // namespace detail
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/bisection.ipp"
#endif
