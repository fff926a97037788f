/// @file
/// The hash of a distributed mesh, by several workers.
#pragma once

#include "dovetail/parallel/any_executor.hpp"

#include "dovetail/mesh/distributed_mesh.hpp"

#include <cstdint>

namespace dovetail::app {

/// `io::mesh_hash(mesh)`, one task per piece. Throws what loading a piece throws.
template <int D>
std::uint64_t parallel_mesh_hash(const distributed_simplicial_mesh<D>& mesh, const any_executor& executor);

} // namespace dovetail::app
