/// @file
/// What `whole_background.hpp` declares.
#pragma once

#include "dovetail/background/whole_domain.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesher/any_line_keeping_mesher.hpp"
#include "dovetail/meshing/piece_work.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/surface_without_crossings.hpp"
#include "dovetail/pipeline/whole_background.hpp"

#include <cstddef>
#include <string>
#include <utility>

namespace dovetail {

template <bound_parameters<3> Parameters>
background_result<3> make_background_by(const any_line_keeping_mesher& mesh_whole, const any_geometry& model,
                                        const erased_sizing& size, const Parameters& given) {
  if (const std::size_t solids = model.topology().solids.size(); solids != 1)
    throw geometry_error(
        "the model has " + std::to_string(solids) +
        " solids, and a mesher of whole domains makes the background mesh of one; use the native "
        "background mesher");
  const auto make = [&](background_result<3>& result, const any_sizing& coarse,
                        const any_executor& run_tasks) {
    // The domain is finer than the mesh of it, so that its points are near to the CAD surface.
    constexpr double finer = 0.4;
    given.options.on_progress("background surface", 0, 0);
    auto domain = surface_without_crossings(
        model, [coarse](vec3 p) { return finer * coarse(p); }, run_tasks, given.mesh_surface,
        given.options.refinement_rounds, given.options.on_progress);
    result.summary.children.push_back(domain.summary);

    given.options.on_progress("background volume", 0, 0);
    const simplicial_mesh<2> shape = outer_surface(domain.surface, model.topology());
    auto whole = mesh_whole.with_lines(background::lines_on_curves(domain.surface))({shape, 0}, coarse);
    result.summary.children.push_back(std::move(whole.summary));
    result.mesh = background::background_of_whole_domain(model, domain.surface, whole.mesh);
    if (is_given(given.improve_background)) {
      const mesher_input<3> frozen{outer_surface(result.mesh.surface, model.topology()), 0};
      mesher_result<3> made{std::move(result.mesh.volume), {}};
      result.summary.children.push_back(
          detail::by_policy("background improver", policy_name(given.improve_background), [&] {
            return detail::improve_checked<3>(made, frozen, given.improve_background, coarse);
          }));
      result.mesh.volume = std::move(made.mesh);
    }
  };
  return make_background<3>(model, size, given, background_maker<3>(make));
}

#ifdef DOVETAIL_COMPILED
template background_result<3> make_background_by(const any_line_keeping_mesher&, const any_geometry&,
                                                 const erased_sizing&, const any_parameters<3>&);
#endif

} // namespace dovetail
