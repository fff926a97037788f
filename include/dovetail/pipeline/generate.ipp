/// @file
/// What `generate.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/selected_pieces.hpp"
#include "dovetail/parallel/clock_watch.hpp"
#include "dovetail/pipeline/assemble_mesh.hpp"
#include "dovetail/pipeline/compare_with_plan.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/given_up.hpp"
#include "dovetail/pipeline/only.hpp"
#include "dovetail/pipeline/rounds.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// For one subdomain there is no volume (`make_background`).
template <int D, bound_parameters<D> Parameters>
divided_background<D> divide_if_planned(const any_geometry& model, const background_result<D>& background,
                                        const Parameters& given) {
  if constexpr (D == 3)
    if (background.mesh.volume.elements.empty())
      return leave_undivided(background.mesh.surface, model.topology());
  return divide<D>(background.mesh, background.size, background.plan.subdomains, given);
}

/// What follows the background mesh, which is moved into the result. Nothing, and why, where too many
/// subdomains would have to be merged; `account` then tells of this decomposition too, besides those before.
template <int D, bound_parameters<D> Parameters>
std::optional<generated<D>> generate_once(const any_geometry& model, background_result<D>& background,
                                          const Parameters& given, report& account,
                                          std::string& too_many_merges) {
  auto divided = divide_if_planned(model, background, given);
  decomposition_rounds rounds(model, background.mesh, divided, background.size, given, account);
  auto made = rounds.mesh_pieces();
  if (!made) {
    account = rounds.give_up();
    add_time(account, "simplification", divided.simplification.seconds);
    add_time(account, "partition", divided.partition.seconds);
    too_many_merges = rounds.too_many_merges();
    return {};
  }
  auto& [skeleton, meshed] = *made;
  generated<D> result;
  result.plan = background.plan;
  if (!background.mesh.elements().elements.empty())
    result.subdomain_of_element = skeleton.subdomain_of_element;
  result.subdomains = skeleton.material_of_subdomain.size();
  result.coarse_angles = std::move(divided.angles);
  result.fine_angles = rounds.take_fine_angles();
  result.quality = meshed.quality;
  result.mesh = assemble_mesh<D>(model, std::move(skeleton.fine), meshed);
  result.only = rounds.wanted();
  if (!result.only.empty())
    result.mesh = selected_pieces<D>(result.mesh, result.only);
  result.failures = std::move(meshed.failures);
  result.summary.name = "generate";
  report intersection = rounds.intersection();
  std::vector<report>& stages = result.summary.children;
  stages = {std::move(background.summary), std::move(divided.simplification), std::move(divided.partition),
            std::move(skeleton.summary), std::move(meshed.summary)};
  give_time_to_stages(intersection, stages);
  stages.insert(stages.end() - 1, std::move(intersection));
  result.background = std::move(background.mesh);
  return result;
}

} // namespace detail

template <int D, bound_parameters<D> Parameters>
generated<D> generate_from_background(const any_geometry& model, background_result<D> background,
                                      const Parameters& wanted) {
  detail::require_growing_only(wanted.options);
  detail::require_separable<D>(wanted.options);
  const stopwatch clock;
  Parameters given = wanted;
  const parallel::clock_watch watch(wanted.run_tasks, wanted.options.limit_seconds);
  given.run_tasks = watch;
  given_up_decompositions<D> given_up(given.run_tasks);
  report account; // of decompositions that were given up
  for (int& subdomains = background.plan.subdomains;; subdomains /= 2) {
    if (auto found = given_up.find(background)) {
      account = *std::move(found);
      continue;
    }
    std::string too_many_merges;
    if (auto result = detail::generate_once<D>(model, background, given, account, too_many_merges)) {
      // Pieces count theirs themselves, in a run that finds them again too.
      const double of_pieces = stops_by_clock(result->summary.find("meshing"));
      result->summary.set(clock_counts{std::max(0.0, watch.stops() - of_pieces)});
      result->summary.seconds = result->summary.children.front().seconds + clock.seconds();
      if (given.options.only.empty())
        compare_with_plan(result->plan.predicted_elements, static_cast<double>(result->quality.elements),
                          result->summary);
      return *std::move(result);
    }
    if (subdomains <= 1)
      throw intersection_error(too_many_merges);
    if (given.options.alone)
      throw intersection_error(
          "pieces cannot be made alone here, as the whole mesh would be divided into fewer: " +
          too_many_merges + "; give half as many subdomains");
    account.warnings.push_back(std::to_string(subdomains) + " subdomains were too many, so " +
                               std::to_string(subdomains / 2) + " were asked for: " + too_many_merges);
    report kept = account;
    if (watch.stops() > 0)
      kept.set(clock_counts{kept.as<clock_counts>().stops_by_clock + watch.stops()});
    given_up.keep(background, kept);
  }
}

#ifdef DOVETAIL_COMPILED
template generated<2> generate_from_background<2>(const any_geometry& model, background_result<2> background,
                                                  const any_parameters<2>& given);
template generated<3> generate_from_background<3>(const any_geometry& model, background_result<3> background,
                                                  const any_parameters<3>& given);
#endif

} // namespace dovetail
