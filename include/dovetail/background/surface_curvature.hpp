/// @file
/// Samples the curvature of a model's faces, as balls that bound the size of its coarse surface mesh.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/size_balls.hpp"
#include "dovetail/sizing/surface_samples.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace dovetail::background {

/// How curvature becomes size.
struct curvature_rule {
  double turn;              ///< of the normal per edge, in radians
  double smallest_fraction; ///< curvature asks for no less than this times the given size
};

/// Balls where curvature asks for a smaller size than `sizing` gives, as dense as the size found there.
template <geometry_model Geometry, sizing_field Size>
std::vector<size_ball> curvature_balls(const Geometry& model, const Size& size, const curvature_rule& rule) {
  constexpr double sizes_apart = 1.5;
  const auto spacing = [&](const sizing::surface_sample& s) {
    const double given = size(s.point);
    if (s.curvature * given <= rule.turn)
      return std::numeric_limits<double>::infinity();
    return sizes_apart * std::max(rule.turn / s.curvature, rule.smallest_fraction * given);
  };
  constexpr sizing::sampling_limits limits{
      .per_face = 4000, .least_halvings = 3, .most_halvings = 12, .halvings_of_curves = 9};
  std::vector<size_ball> balls;
  for (const auto& s : sizing::sample_surface(model, spacing, limits))
    if (s.spacing < std::numeric_limits<double>::infinity())
      balls.push_back({s.point, 0, s.spacing / sizes_apart});
  return balls;
}

} // namespace dovetail::background
