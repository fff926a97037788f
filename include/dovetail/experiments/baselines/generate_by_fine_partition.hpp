/// @file
/// Over-decomposition of a fine mesh: the domain is meshed as a whole, and parts of the mesh are improved in
/// parallel. What a decomposition of a coarse mesh is there to avoid.
#pragma once

#include "dovetail/pipeline/any_parameters.hpp"
#include "dovetail/pipeline/generate.hpp"

namespace dovetail::baselines {

/// Meshes each solid in one piece, by one task, and leaves it as the mesher made it; partitions the graph of
/// all its elements; and improves each part inside its boundary, in parallel:
///
///     auto mesh = generate_by_fine_partition(model, size, parameters<>{}.with_mesher(mesher::tetgen{}));
///
/// Nothing is simplified and no background mesh is made: interfaces are whatever sides of the fine mesh the
/// partitioner cuts, and stay as they are. There are as many parts as `given` has subdomains, or else one for
/// so many elements, and parts that are not connected are several pieces. The mesh is the same for any
/// executor. Throws what `generate`, `redistribution_by::elements` and `improve_pieces` throw. Solids that
/// cannot be meshed are `failures`, and then nothing is partitioned.
///
/// Children of the summary: what `generate` has of one subdomain, "fine partition" (what
/// `redistribution_by::elements` says), "improvement". Memory: a worker has the mesh of the largest solid,
/// and each process the graph of all elements.
/// Complexity: as the mesher, the partitioner and the improver on all elements.
/// \param model the solids to mesh
/// \param size edge lengths wanted, in the units of the model
/// \param given mesher, improver, partitioner, executor and options, as for `generate`
/// \param elements_per_part elements of a part, where the options do not give a number of subdomains
generated<3> generate_by_fine_partition(const any_geometry& model, const erased_sizing& size,
                                        const any_parameters<3>& given, double elements_per_part = 20000);

} // namespace dovetail::baselines

#ifndef DOVETAIL_COMPILED
#include "dovetail/experiments/baselines/generate_by_fine_partition.ipp"
#endif
