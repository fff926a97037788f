/// @file
/// What `generate.hpp` declares.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/parallel/clock_watch.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/pipeline/assemble_mesh.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/rounds.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

template <int D>
auto mesh_or_give_up(decomposition_rounds<D>& rounds, report& account) {
  try {
    return rounds.mesh_pieces();
  } catch (const too_many_merges&) {
    account = rounds.give_up();
    throw;
  }
}

/// Under which it is kept in the spool that a decomposition was given up; the rest is in the identity.
template <int D>
content_key key_of_given_up(const background_result<D>& background) {
  key_maker make;
  make(std::int64_t{D})(std::int64_t{background.plan.subdomains});
  return make(static_cast<std::int64_t>(background.mesh.elements().elements.size())).key();
}

/// For one subdomain there is no volume (`make_background`).
template <int D>
divided_background<D> divide_if_planned(const any_geometry& model, const background_result<D>& background,
                                        const any_parameters<D>& given) {
  if constexpr (D == 3)
    if (background.mesh.volume.elements.empty())
      return leave_undivided(background.mesh.surface, model.topology());
  return divide<D>(background.mesh, background.size, background.plan.subdomains, given);
}

/// What follows the background mesh, which is taken when all went well. `account` is that of the
/// decompositions before, and when this one is given up of all.
template <int D>
generated<D> generate_once(const any_geometry& model, background_result<D>& background,
                           const any_parameters<D>& given, report& account) {
  generated<D> result;
  result.summary.name = "generate";
  result.plan = background.plan;
  auto divided = divide_if_planned(model, background, given);
  decomposition_rounds<D> rounds(model, background.mesh, divided, background.size, given, account);
  auto [skeleton, meshed] = mesh_or_give_up(rounds, account);
  if (!background.mesh.elements().elements.empty())
    result.subdomain_of_element = skeleton.subdomain_of_element;
  result.coarse_angles = std::move(divided.angles);
  result.fine_angles = rounds.take_fine_angles();
  result.quality = meshed.quality;
  result.mesh = assemble_mesh<D>(model, std::move(skeleton.fine), meshed);
  result.failures = std::move(meshed.failures);
  result.summary.children = {std::move(background.summary), std::move(divided.simplification),
                             std::move(divided.partition),  std::move(skeleton.summary),
                             rounds.intersection(),         std::move(meshed.summary)};
  result.background = std::move(background.mesh);
  return result;
}

} // namespace detail

template <int D>
generated<D> generate_from_background(const any_geometry& model, background_result<D> background,
                                      const any_parameters<D>& wanted) {
  const stopwatch clock;
  any_parameters<D> given = wanted;
  const parallel::clock_watch watch(wanted.run_tasks, wanted.options.limit_seconds);
  given.run_tasks = watch;
  // A run that goes on does not begin with a decomposition that was given up: its pieces are no more.
  std::optional<entity_store> given_up;
  if (wanted.options.store)
    given_up.emplace(wanted.options.store, "given_up");
  report account; // of decompositions that were given up
  for (int& subdomains = background.plan.subdomains;; subdomains /= 2) {
    const content_key key = detail::key_of_given_up(background);
    const auto find_given_up = [&] { return given_up->find_value<report>(key); };
    if (auto found = given_up ? given.run_tasks.once(find_given_up) : std::nullopt) {
      account = *std::move(found);
      continue;
    }
    try {
      auto result = detail::generate_once<D>(model, background, given, account);
      // Pieces count theirs themselves, in a run that finds them again too.
      const double of_pieces = stops_by_clock(result.summary.find("meshing"));
      result.summary.set("stops_by_clock", std::max(0.0, watch.stops() - of_pieces));
      result.summary.seconds = result.summary.children.front().seconds + clock.seconds();
      return result;
    } catch (const too_many_merges& refused) {
      if (subdomains <= 1)
        throw;
      account.warnings.push_back(std::to_string(subdomains) + " subdomains were too many, so " +
                                 std::to_string(subdomains / 2) + " were asked for: " + refused.what());
      if (given_up && given.run_tasks.leads()) {
        report kept = account;
        if (watch.stops() > 0)
          kept.add("stops_by_clock", watch.stops());
        given_up->keep_value(key, kept);
      }
    }
  }
}

#ifdef DOVETAIL_COMPILED
template generated<2> generate_from_background<2>(const any_geometry& model, background_result<2> background,
                                                  const any_parameters<2>& given);
template generated<3> generate_from_background<3>(const any_geometry& model, background_result<3> background,
                                                  const any_parameters<3>& given);
#endif

} // namespace dovetail
