/// @file
/// How many parts each component gets.
#pragma once

#include "dovetail/core/ids.hpp"

#include <span>
#include <vector>

namespace dovetail {

/// One part for each component, then the rest one by one to the component whose parts are heaviest on
/// average (ties to the first), never more parts than a component has nodes. So the result has at least as
/// many parts as there are components, and `parts` when there are nodes enough.
std::vector<int> apportion_parts(std::span<const double> component_weights,
                                 std::span<const local_id> component_nodes, int parts);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/apportion.ipp"
#endif
