/// @file
/// The coarse surface mesh, as fine as it must be for no two of its triangles to cross.
#pragma once

#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/remesh/concepts.hpp"

#include <functional>

namespace dovetail {

namespace detail {

/// `surface_without_crossings` by a function that makes the surface mesh.
background::coarse_surface_result surface_without_crossings_by(
    const any_geometry& model,
    const std::function<background::coarse_surface_result(const background::coarse_surface_parameters&)>&
        make,
    const any_executor& run, int refinement_rounds, const progress& on_progress);

} // namespace detail

/// The surface mesh at a size, refined locally until no two of its triangles cross. Throws
/// `intersection_error` naming the two CAD faces when that does not help.
/// \param refinement_rounds how often sizes may be refined at crossings
template <surface_mesher Mesher>
background::coarse_surface_result
surface_without_crossings(const any_geometry& model, const any_sizing& size, const any_executor& run,
                          const Mesher& mesher, int refinement_rounds, const progress& on_progress = {}) {
  const auto make = [&](const background::coarse_surface_parameters& parameters) {
    return background::coarse_surface(model, size, parameters, run, mesher);
  };
  return detail::surface_without_crossings_by(model, make, run, refinement_rounds, on_progress);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/surface_without_crossings.ipp"
#endif
