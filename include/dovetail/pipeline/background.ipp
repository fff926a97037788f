/// @file
/// What `background.hpp` declares.
#pragma once

#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/intersection/offending_facets.hpp"
#include "dovetail/mesher/background_form.hpp"
#include "dovetail/parallel/clock_watch.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/kept_background.hpp"
#include "dovetail/pipeline/planning.ipp"
#include "dovetail/pipeline/surface_without_crossings.hpp"
#include "dovetail/sizing/coarse.hpp"

#include <utility>

namespace dovetail {

template <int D, bound_parameters<D> Parameters>
background_result<D> make_background(const any_geometry& model, const erased_sizing& given_size,
                                     const Parameters& wanted, const background_maker<D>& make) {
  const stopwatch clock;
  Parameters given = wanted;
  const parallel::clock_watch watch(wanted.run_tasks, wanted.options.limit_seconds);
  given.run_tasks = watch;
  const generate_options& options = given.options;
  const erased_sizing size = detail::usable_size<D>(model, given_size, given).size;
  if (auto kept = find_background<D>(model, size, wanted.run_tasks)) {
    detail::require_room(kept->plan, options);
    return *std::move(kept);
  }
  background_result<D> result;
  result.summary.name = "background";
  result.plan = detail::plan_of_usable<D>(model, size, given, detail::planned::walls_too);
  const erased_sizing planned = enlarged(size, result.plan);
  result.size = planned;
  make(result, coarse_size(planned, result.plan.coarse_scale, model.bounds(), result.plan.walls),
       given.run_tasks);
  result.plan.walls = {}; // of no further use
  result.size = allowed_size<D>(planned, result.bounds);
  if (result.plan.size_scale != 1)
    result.summary.warnings.push_back("the sizes were enlarged by a factor of " +
                                      number_text(result.plan.size_scale, 3) + ", for about " +
                                      number_text(result.plan.predicted_elements, 3) + " elements");
  result.summary.set(background_counts{.predicted_elements = result.plan.predicted_elements,
                                       .coarse_scale = result.plan.coarse_scale,
                                       .size_scale = result.plan.size_scale,
                                       .elements = result.mesh.elements().elements.size(),
                                       .stops_by_clock = watch.stops()});
  result.summary.seconds = clock.seconds();
  keep_background(model, size, result, wanted.run_tasks);
  return result;
}

template <int D, bound_parameters<D> Parameters>
background_result<D> make_background(const any_geometry& model, const erased_sizing& given_size,
                                     const Parameters& given) {
  const auto make = [&](background_result<D>& result, any_sizing coarse, const any_executor& run_tasks) {
    const generate_options& options = given.options;
    options.on_progress("background surface", 0, 0);
    const auto surface_at = [&](const any_sizing& size) {
      return surface_without_crossings(model, size, run_tasks, given.mesh_surface, options.refinement_rounds,
                                       options.on_progress);
    };
    auto surface = surface_at(coarse);
    if (D == 3 && options.coarse_scale == 0 && result.plan.subdomains > 1 &&
        has_form_for_background(given.mesh_it) &&
        static_cast<double>(surface.surface.mesh.elements.size()) >
            result.plan.subdomains * options.background_elements_per_subdomain) {
      // Small sizes at the surface alone make more elements than are needed; where they are made without
      // regard to their angles, it takes so many to find clean interfaces among them.
      result.plan.coarse_scale *= 2;
      coarse = coarse_size(result.size, result.plan.coarse_scale, model.bounds(), result.plan.walls);
      surface = surface_at(coarse);
    }
    result.summary.children.push_back(std::move(surface.summary));
    if constexpr (D == 2)
      result.bounds = std::move(surface.bounds);
    result.mesh.surface = std::move(surface.surface);
    if constexpr (D == 3) {
      if (result.plan.subdomains == 1)
        return;
      options.on_progress("background volume", 0, 0);
      auto volume =
          background::coarse_volume(result.mesh.surface, model.topology(), coarse,
                                    form_for_background(given.mesh_it), given.improve_background, run_tasks,
                                    {.on_failure = write_facets_of_failures(options.failure_folder),
                                     .on_progress = options.on_progress.only_stopping()});
      result.mesh.volume = std::move(volume.mesh);
      result.summary.children.push_back(std::move(volume.summary));
    }
  };
  return make_background<D>(model, given_size, given, background_maker<D>(make));
}

#ifdef DOVETAIL_COMPILED
template background_result<2> make_background<2>(const any_geometry& model, const erased_sizing& size,
                                                 const any_parameters<2>& given);
template background_result<2> make_background<2>(const any_geometry& model, const erased_sizing& size,
                                                 const any_parameters<2>& given,
                                                 const background_maker<2>& make);
template background_result<3> make_background<3>(const any_geometry& model, const erased_sizing& size,
                                                 const any_parameters<3>& given);
template background_result<3> make_background<3>(const any_geometry& model, const erased_sizing& size,
                                                 const any_parameters<3>& given,
                                                 const background_maker<3>& make);
#endif

} // namespace dovetail
