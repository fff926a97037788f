/// @file
/// What `edge_middles.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/solver/edge_middles.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::optional<vec3> edge_middles::operator()(vec3 a, vec3 b, host on) {
  const vec3 straight = midpoint(a, b);
  if (on.dimension == 2 ? model_.plane_of_face(on.id).has_value() : on.dimension != 1)
    return straight;
  const double length = distance(a, b);
  for (const auto& seed : nearest_samples(straight, on)) {
    const auto found = projected(straight, on, seed.at);
    if (!found || !(distance(*found, straight) <= longest_way * length))
      continue;
    return distance(*found, straight) <= rounding * length ? straight : *found;
  }
  return std::nullopt;
}

DOVETAIL_INLINE std::optional<vec3> edge_middles::projected(vec3 p, host on, vec2 seed) const {
  try {
    return on.dimension == 1 ? model_.curve_point(on.id, model_.project_to_curve(on.id, p, seed.x))
                             : model_.face_point(on.id, model_.project_to_face(on.id, p, seed));
  } catch (const geometry_error&) { // of a place where the kernel cannot evaluate it
    return std::nullopt;
  }
}

DOVETAIL_INLINE std::vector<edge_middles::sample> edge_middles::nearest_samples(vec3 p, host on) {
  auto& samples = samples_[on];
  if (samples.empty())
    samples = on.dimension == 1 ? of_curve(on.id) : of_face(on.id);
  std::vector<sample> nearest(std::min(tried, samples.size()));
  std::partial_sort_copy(samples.begin(), samples.end(), nearest.begin(), nearest.end(),
                         [p](const sample& a, const sample& b) {
                           return norm_squared(a.point - p) < norm_squared(b.point - p);
                         });
  return nearest;
}

DOVETAIL_INLINE std::vector<edge_middles::sample> edge_middles::of_curve(local_id c) const {
  const auto& curve = model_.topology().curves[c];
  std::vector<sample> samples;
  for (int i = 0; i < curve_samples && !curve.degenerate; ++i) {
    const double t = curve.t[0] + (curve.t[1] - curve.t[0]) * i / (curve_samples - 1);
    try {
      samples.push_back({{t, 0}, model_.curve_point(c, t)});
    } catch (const geometry_error&) { // the others will do
    }
  }
  return samples;
}

DOVETAIL_INLINE std::vector<edge_middles::sample> edge_middles::of_face(local_id f) const {
  const auto& topology = model_.topology();
  const auto& coedges = topology.faces[f].coedges;
  box3 parameters;
  for (std::size_t k = 0; k < coedges.size(); ++k) {
    const auto& t = topology.curves[coedges[k].curve].t;
    constexpr int steps = 8;
    for (int i = 0; i <= steps; ++i) {
      const vec2 uv = model_.curve_uv(f, static_cast<int>(k), t[0] + (t[1] - t[0]) * i / steps);
      parameters.include({uv.x, uv.y, 0});
    }
  }
  std::vector<sample> samples;
  const vec3 step = (parameters.upper - parameters.lower) / (face_samples - 1);
  for (int i = 0; i < face_samples; ++i)
    for (int j = 0; j < face_samples; ++j) {
      const vec2 uv{parameters.lower.x + i * step.x, parameters.lower.y + j * step.y};
      try {
        samples.push_back({uv, model_.face_point(f, uv)});
      } catch (const geometry_error&) { // outside of the face, where it need not be defined
      }
    }
  return samples;
}

} // namespace dovetail
