/// @file
/// What `model_measure.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/pipeline/model_measure.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

namespace dovetail {

DOVETAIL_INLINE double volume_inside(const simplicial_skeleton<3>& skeleton) {
  const auto point = [&](local_id v) { return skeleton.points[v]; };
  box3 box;
  for (const vec3& p : skeleton.points)
    box.include(p);
  const vec3 origin = box.center(); // near the mesh, for the sake of rounding
  double sum = 0;
  for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
    if (const auto& side = skeleton.sides[s]; skeleton.subdomains[s][1] == no_id)
      sum += signed_volume(origin, point(side[0]), point(side[1]), point(side[2]));
  return sum;
}

DOVETAIL_INLINE void compare_volume(const simplicial_skeleton<3>& skeleton,
                                    const std::optional<double>& of_model, report& summary) {
  if (!of_model || !std::isfinite(*of_model))
    return;
  const double volume = volume_inside(skeleton);
  const double gap = deviation_in(summary.find("skeleton").find("deviation")).gap;
  summary.set(volume_counts{volume, *of_model});
  constexpr double worth_telling = 0.2;
  constexpr double of_kernel = 3e-6; // about as far are the volumes off that geometry kernels give
  if (std::abs(volume - *of_model) > 2 * gap + of_kernel * std::abs(*of_model))
    summary.warnings.push_back("the mesh fills a volume of " + number_text(volume) + ", and the model has " +
                               number_text(*of_model) + "; the distance between their surfaces explains " +
                               number_text(gap, 2) +
                               " of that: a part of the boundary is not where the "
                               "model has it, so look at the mesh before using it");
  else if (const double share = std::abs(volume / *of_model - 1); share > worth_telling)
    summary.warnings.push_back("the mesh fills a volume of " + number_text(volume) + ", and the model has " +
                               number_text(*of_model) + ", " + number_text(100 * share, 2) +
                               " % off: sizes are large for what the model has; smaller ones follow it");
}

} // namespace dovetail
