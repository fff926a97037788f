/// @file
/// Sizes from the curvature of a CAD model: so many elements per full circle.
#pragma once

#include "dovetail/sizing/point_sizes.hpp"
#include "dovetail/sizing/surface_samples.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

namespace dovetail {

/// What the fields that come from a model have in common. Lengths are in the model's unit.
struct model_size_range {
  double smallest = 0;  ///< no size is below; 0: a thousandth of the model's diagonal
  double largest = 0;   ///< nor above; 0: a tenth of the diagonal
  double growth = 0.25; ///< of the size per length, away from where it is small
};

/// How curvature gives sizes.
struct curvature_options {
  double elements_per_circle = 24; ///< edges along a full circle
  model_size_range range = {};     ///< no size is outside of it
};

namespace sizing {

/// The range with its defaults filled in. Throws `sizing_error` when it is empty.
model_size_range range_for(const box3& bounds, model_size_range range);

/// Sizes of 2 pi / (elements x curvature) on the faces of a model, where that is below the largest.
/// \param elements_per_circle edges around a circle of curvature
template <geometry_model G>
std::vector<sized_point> curvature_points(const G& model, double elements_per_circle,
                                          const model_size_range& range) {
  checked_size(elements_per_circle, "the number of elements per circle");
  const double turn = 2 * std::numbers::pi / elements_per_circle;
  constexpr double sizes_apart = 1.5;
  const auto spacing = [&](const surface_sample& s) {
    if (s.curvature * range.largest <= turn)
      return std::numeric_limits<double>::infinity();
    return sizes_apart * std::max(range.smallest, turn / s.curvature);
  };
  std::vector<sized_point> points;
  for (const surface_sample& s : sample_surface(model, spacing))
    if (s.spacing < sizes_apart * range.largest)
      points.push_back({s.point, s.spacing / sizes_apart});
  return points;
}

} // namespace sizing

/// The field that puts `elements_per_circle` edges around every circle of curvature of a face. Some thousand
/// curvature queries per curved face. Throws `sizing_error` for options out of range.
/// About n log n in the samples.
/// \param model the model whose faces are sampled
/// \param options elements per circle, and the range of sizes
template <geometry_model G>
point_sizes curvature_size(const G& model, const curvature_options& options = {}) {
  const model_size_range range = sizing::range_for(model.bounds(), options.range);
  return {sizing::curvature_points(model, options.elements_per_circle, range), range.growth, range.largest};
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/curvature.ipp"
#endif
