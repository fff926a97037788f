/// @file
/// Whether the entities that a model says it has refer to each other as they should.
#pragma once

#include "dovetail/geometry/concepts.hpp"

namespace dovetail {

/// Throws `geometry_error` naming the first entity that refers to one that is not there, has a parameter
/// range that is none, or whose loops and coedges differ in number. Linear in the size of the topology.
/// \param topology of a model
void check_topology(const geometry_topology& topology);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/geometry/topology_checks.ipp"
#endif
