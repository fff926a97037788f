/// @file
/// Makes every part connected.
#pragma once

#include "dovetail/graph/csr_graph.hpp"

#include <cstddef>
#include <span>
#include <utility>

namespace dovetail {

/// Joins every component of a part but its heaviest to the neighbouring component with which it shares the
/// largest edge weight, the lightest component first. Parts neither vanish nor appear. A stray component
/// without any neighbour stays. Returns how many components were joined. Each join removes a component, so
/// this terminates.
std::size_t join_stray_components(const csr_graph& graph, std::span<local_id> part, int parts);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/connectivity.ipp"
#endif
