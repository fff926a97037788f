/// @file
/// Sizes from a CAD model alone: curvature, proximity and limited growth together, after the idea of J. Chen,
/// Z. Xiao, Y. Zheng, J. Zheng, C. Li and K. Liang, "Automatic sizing functions for unstructured surface mesh
/// generation" (2017): sizes are found at points of the model and then limited in their growth.
#pragma once

#include "dovetail/sizing/proximity.hpp"
#include "dovetail/sizing/tabulated.hpp"

#include <vector>

namespace dovetail {

/// What a size from the model goes by. Lengths are in the model's unit.
struct automatic_options {
  double elements_per_circle = 24; ///< 0: curvature does not count
  double elements_across = 2;      ///< of walls and gaps; 0: proximity does not count
  bool inside = true;              ///< thin walls
  bool outside = false;            ///< gaps between faces
  model_size_range range = {};     ///< no size is outside of it
};

/// The smallest of what curvature and proximity ask for, as one field of limited growth, precomputed in the
/// model's box. Throws `sizing_error` for options out of range.
/// Complexity: that of `curvature_size` and `proximity_size`, and linear in the cells of the table.
/// \param model the model whose faces are sampled
/// \param options elements per circle and per gap, and the range of sizes
template <geometry_model G>
tabulated_size automatic_size(const G& model, const automatic_options& options = {}) {
  const model_size_range range = sizing::range_for(model.bounds(), options.range);
  std::vector<sized_point> points;
  if (options.elements_per_circle != 0)
    points = sizing::curvature_points(model, options.elements_per_circle, range);
  if (options.elements_across != 0) {
    const auto near = sizing::proximity_points(
        model, {.elements = options.elements_across, .inside = options.inside, .outside = options.outside},
        range);
    points.insert(points.end(), near.begin(), near.end());
  }
  const box3 bounds = model.bounds();
  return {point_sizes(std::move(points), range.growth, range.largest),
          inflated(bounds, 1e-3 * bounds.diagonal())};
}

} // namespace dovetail
