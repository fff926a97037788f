/// @file
/// What `generate_by_fine_partition.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/improve_pieces.hpp"
#include "dovetail/experiments/baselines/generate_by_fine_partition.hpp"
#include "dovetail/experiments/baselines/interface_angles_of_skeleton.hpp"
#include "dovetail/experiments/baselines/labelled_elements.hpp"
#include "dovetail/pipeline/only.hpp"
#include "dovetail/simplification/none.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dovetail::baselines {

DOVETAIL_INLINE generated<3> generate_by_fine_partition(const any_geometry& model, const erased_sizing& size,
                                                        const any_parameters<3>& given,
                                                        double elements_per_part) {
  dovetail::detail::refuse_only(given.options, "a partition of a fine mesh");
  const stopwatch clock;
  any_parameters<3> whole = given;
  whole.options.subdomains = 1;
  whole.improve_it = {};
  auto background = make_background<3>(model, size, whole);
  const any_sizing sizes = background.size;
  generated<3> made = generate_from_background<3>(model, std::move(background), whole);
  if (!made.failures.empty())
    return made;
  made.plan.subdomains =
      given.options.subdomains > 0
          ? given.options.subdomains
          : static_cast<int>(
                std::max(1.0, std::round(static_cast<double>(made.quality.elements) / elements_per_part)));
  auto parted =
      redistribution_by::elements{.partitioner = given.partition_it,
                                  .simplify_by = simplifier::none{},
                                  .super_elements = std::numeric_limits<int>::max(), // each element is one
                                  .seam_weight = 1,
                                  .run_tasks = given.run_tasks,
                                  .on_progress = within_stage(given.options.on_progress, "fine partition")}(
          made.mesh, made.plan.subdomains);
  const stopwatch measuring; // in the same stage: improvement leaves interfaces as they are
  made.fine_angles = detail::angles_of_interfaces(parted.mesh->skeleton, sizes, given.simplify_by);
  parted.summary.seconds += measuring.seconds();
  auto improved = improve_pieces(*parted.mesh, given.improve_it, sizes, given.run_tasks,
                                 {.on_progress = given.options.on_progress});
  made.mesh = std::move(improved.mesh);
  made.quality = improved.quality;
  made.subdomains = made.mesh.counts.size();
  parted.summary.name = "fine partition";
  made.summary.children.push_back(std::move(parted.summary));
  made.summary.children.push_back(std::move(improved.summary));
  made.summary.seconds = clock.seconds();
  return made;
}

} // namespace dovetail::baselines
