/// @file
/// What `generate_bisected.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/experiments/baselines/generate_bisected.hpp"
#include "dovetail/experiments/baselines/interface_angles_of_skeleton.hpp"
#include "dovetail/pipeline/assemble_mesh.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/only.hpp"
#include "dovetail/pipeline/piece_meshing.hpp"
#include "dovetail/pipeline/rounds.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::baselines {

DOVETAIL_INLINE generated<3> generate_bisected(const any_geometry& model, const erased_sizing& size,
                                               const any_parameters<3>& given,
                                               const recursive_bisection& bisect) {
  dovetail::detail::refuse_only(given.options, "a recursive bisection");
  const stopwatch clock;
  any_parameters<3> undivided = given;
  undivided.options.subdomains = 1;
  auto background = make_background<3>(model, size, undivided);
  const auto solids = leave_undivided(background.mesh.surface, model.topology());
  decomposition_rounds rounds(model, background.mesh, solids, background.size, undivided);
  auto boundaries = rounds.realize_boundaries();
  if (!boundaries)
    throw intersection_error(rounds.too_many_merges());
  realized<3>& made = *boundaries;
  recursive_bisection with_progress = bisect;
  with_progress.on_progress = given.options.on_progress;
  bisected_surface divided =
      with_progress(std::move(made.fine), std::move(made.material_of_subdomain), rounds.size());
  made.fine = std::move(divided.fine);
  made.material_of_subdomain = std::move(divided.material_of_subdomain);
  generated<3> result;
  const stopwatch measuring; // in the stage of the bisection
  result.fine_angles = detail::angles_of_interfaces(made.fine, rounds.size(), given.simplify_by);
  divided.summary.seconds += measuring.seconds();
  auto meshed = mesh_wanted_pieces<3>(model, background.mesh, made, {}, rounds.size(), given);
  result.plan = background.plan;
  result.plan.subdomains = static_cast<int>(made.material_of_subdomain.size());
  result.quality = meshed.quality;
  result.subdomains = meshed.pieces.size();
  result.mesh = dovetail::detail::assemble_mesh<3>(model, std::move(made.fine), meshed);
  result.failures = std::move(meshed.failures);
  result.summary.name = "generate";
  result.summary.children = {std::move(background.summary), std::move(made.summary), rounds.intersection(),
                             std::move(divided.summary), std::move(meshed.summary)};
  result.background = std::move(background.mesh);
  result.summary.seconds = clock.seconds();
  return result;
}

} // namespace dovetail::baselines
