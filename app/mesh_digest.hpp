/// @file
/// The hash of a distributed mesh, by several workers.
#pragma once

#include "any_policies.hpp"

#include "dovetail/mesh/distributed_mesh.hpp"

#include <cstdint>

namespace dovetail::app {

/// `io::mesh_hash(mesh)`, one task per piece. Throws what loading a piece throws.
std::uint64_t parallel_mesh_hash(const distributed_mesh& mesh, const any_executor& executor);

} // namespace dovetail::app
