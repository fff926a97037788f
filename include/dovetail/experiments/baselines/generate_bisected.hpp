/// @file
/// The pipeline with Algorithm 2 of the paper in place of its own domain decomposition.
#pragma once

#include "dovetail/experiments/baselines/recursive_bisection.hpp"
#include "dovetail/pipeline/any_parameters.hpp"
#include "dovetail/pipeline/generate.hpp"

namespace dovetail::baselines {

/// Makes the fine surface mesh of a model, in parallel, divides what is inside by `bisect`, and meshes and
/// improves the subdomains as `generate` does:
///
///     auto mesh = generate_bisected(model, size, parameters<>{}.with_mesher(mesher::tetgen{}), {.most_faces
///     = 20000});
///
/// Of the rule in `given` only the angles that it wants are used, to measure interfaces; what is said of
/// background mesh, partition and number of subdomains has no meaning
/// here, and subdomains that fail are not merged. Throws what `generate` throws before it meshes subdomains.
///
/// The result has no plan of a decomposition and no coarse angles. Children of its summary: "background" (a
/// coarse surface, which says how large the mesh will be), "skeleton" (the fine surface), "intersection",
/// "recursive bisection" (with the measuring of its interfaces' angles), "meshing".
/// Complexity: that of `generate` without a decomposition, and a pass over a boundary per plane that is
/// tried.
/// \param model the solids to mesh
/// \param size edge lengths wanted, in the units of the model
/// \param given mesher, improver, executor and options, as for `generate`
/// \param bisect when to stop cutting, and how
generated<3> generate_bisected(const any_geometry& model, const erased_sizing& size,
                               const any_parameters<3>& given, const recursive_bisection& bisect = {});

} // namespace dovetail::baselines

#ifndef DOVETAIL_COMPILED
#include "dovetail/experiments/baselines/generate_bisected.ipp"
#endif
