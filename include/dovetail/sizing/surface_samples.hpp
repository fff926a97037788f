/// @file
/// Samples of a model's faces, as close together as a rule asks.
#pragma once

#include "dovetail/geometry/concepts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

namespace dovetail::sizing {

/// A point of a face. The normal is the oriented one: it points out of the solid behind the face.
struct surface_sample {
  vec3 point;            ///< on the face
  vec3 normal;           ///< of unit length; zero where the parametrisation is singular
  vec2 uv;               ///< its parameters on the face
  double curvature = 0;  ///< largest absolute principal curvature
  local_id face = no_id; ///< the number of the face in the model
  double spacing = 0;    ///< what the rule gave for the other members
  double area = 0;       ///< of the face, about, that no other sample is nearer to; 0 on its curves
};

/// Where sampling ends, however small the spacing.
struct sampling_limits {
  int per_face = 4000;         ///< samples inside
  int least_halvings = 4;      ///< of the parameter rectangle, whatever the spacing
  int most_halvings = 24;      ///< of the parameter rectangle
  int halvings_of_curves = 11; ///< of each quarter of a curve
};

/// Samples faces on their curves, and inside by halving the parameter rectangle, until neighbours are at
/// most `spacing(sample)` apart or a limit is met; large cells first, so that a limit leaves no part of a
/// face without samples. Normals where the parametrisation is singular are zero.
template <geometry_model G, class Spacing>
class surface_sampler {
public:
  surface_sampler(const G& model, const Spacing& spacing, const sampling_limits& limits)
      : model_(model), spacing_(spacing), limits_(limits) {}

  /// All samples, face by face.
  std::vector<surface_sample> run() {
    for (std::size_t f = 0; f < model_.topology().faces.size(); ++f)
      sample_face(static_cast<local_id>(f));
    return std::move(samples_);
  }
  /// Those of one face.
  std::vector<surface_sample> run(local_id face) {
    samples_.clear();
    sample_face(face);
    return std::move(samples_);
  }

private:
  static constexpr int outline_parts = 32;

  surface_sample sample_at(local_id f, vec2 uv) const {
    const surface_frame frame = model_.face_frame(f, uv);
    const bool reversed = model_.topology().faces[f].reversed;
    const vec3 n = normalized(cross(frame.du, frame.dv));
    const double curvature = model_.face_curvature(f, uv);
    surface_sample sample{frame.point, reversed ? -n : n, uv, std::isfinite(curvature) ? curvature : 0, f};
    sample.spacing = spacing_(sample);
    return sample;
  }

  void sample_face(local_id f) {
    outline_.clear();
    const auto& face = model_.topology().faces[f];
    for (std::size_t k = 0; k < face.coedges.size(); ++k)
      sample_coedge(f, static_cast<int>(k), face.coedges[k]);
    vec2 lower{1e300, 1e300};
    vec2 upper{-1e300, -1e300};
    for (const auto& [a, b] : outline_) {
      lower = {std::min(lower.x, a.x), std::min(lower.y, a.y)};
      upper = {std::max(upper.x, a.x), std::max(upper.y, a.y)};
    }
    if (!outline_.empty())
      sample_inside(f, {lower, upper, 0});
  }

  void sample_coedge(local_id f, int k, const geometry_topology::coedge& coedge) {
    const auto& curve = model_.topology().curves[coedge.curve];
    const auto uv_at = [&](double s) {
      return model_.curve_uv(f, k, curve.t[0] + s * (curve.t[1] - curve.t[0]));
    };
    vec2 before = uv_at(0);
    for (int i = 1; i <= outline_parts; ++i) {
      const vec2 uv = uv_at(static_cast<double>(i) / outline_parts);
      outline_.push_back({before, uv});
      before = uv;
    }
    if (curve.degenerate)
      return;
    constexpr int parts = 4;
    double s = 0;
    surface_sample from = sample_at(f, uv_at(0));
    samples_.push_back(from);
    for (int i = 1; i <= parts; ++i) {
      const double next = static_cast<double>(i) / parts;
      const surface_sample to = sample_at(f, uv_at(next));
      samples_.push_back(to);
      sample_between(f, uv_at, s, from, next, to, 0);
      s = next;
      from = to;
    }
  }

  template <class Uv>
  void sample_between(local_id f, const Uv& uv_at, double s0, const surface_sample& a, double s1,
                      const surface_sample& b, int depth) {
    if (depth == limits_.halvings_of_curves || distance(a.point, b.point) <= std::min(a.spacing, b.spacing))
      return;
    const double middle = 0.5 * (s0 + s1);
    const surface_sample m = sample_at(f, uv_at(middle));
    samples_.push_back(m);
    sample_between(f, uv_at, s0, a, middle, m, depth + 1);
    sample_between(f, uv_at, middle, m, s1, b, depth + 1);
  }

  struct cell {
    vec2 lower, upper; ///< of its parameters
    int depth;
    double half_of_parent = 0;      ///< the area that it takes over from the cell that was halved ...
    std::size_t parent = no_sample; ///< ... whose sample this is
  };
  static constexpr std::size_t no_sample = std::numeric_limits<std::size_t>::max();

  void sample_inside(local_id f, const cell& whole) {
    std::deque<cell> cells{whole};
    for (int budget = limits_.per_face; budget > 0 && !cells.empty(); --budget) {
      sample_cell(f, cells.front(), cells);
      cells.pop_front();
    }
  }

  /// Adds the halves of a cell that is too large.
  void sample_cell(local_id f, const cell& c, std::deque<cell>& cells) {
    const vec2 middle = 0.5 * (c.lower + c.upper);
    surface_sample m = sample_at(f, middle);
    const vec3 west = model_.face_point(f, {c.lower.x, middle.y});
    const vec3 east = model_.face_point(f, {c.upper.x, middle.y});
    const vec3 south = model_.face_point(f, {middle.x, c.lower.y});
    const vec3 north = model_.face_point(f, {middle.x, c.upper.y});
    const double across = distance(west, m.point) + distance(m.point, east);
    const double along = distance(south, m.point) + distance(m.point, north);
    m.area = across * along;
    if (c.parent != no_sample)
      samples_[c.parent].area -= c.half_of_parent;
    const std::size_t own = inside(middle) ? samples_.size() : no_sample;
    if (own != no_sample)
      samples_.push_back(m);
    const auto halve = [&](vec2 lower, vec2 upper) {
      cells.push_back({lower, upper, c.depth + 1, 0.5 * m.area, own});
    };
    if (c.depth >= limits_.most_halvings ||
        (c.depth >= limits_.least_halvings && std::max(across, along) <= m.spacing))
      return;
    if (across >= along) {
      halve(c.lower, {middle.x, c.upper.y});
      halve({middle.x, c.lower.y}, c.upper);
    } else {
      halve(c.lower, {c.upper.x, middle.y});
      halve({c.lower.x, middle.y}, c.upper);
    }
  }

  bool inside(vec2 p) const {
    bool in = false;
    for (const auto& [a, b] : outline_)
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
        in = !in;
    return in;
  }

  const G& model_;
  const Spacing& spacing_;
  sampling_limits limits_;
  std::vector<surface_sample> samples_;
  std::vector<std::array<vec2, 2>> outline_; ///< of the face at hand
};

/// All samples of a model. Throws what the model's queries throw.
/// \param spacing the distance of samples at a place
template <geometry_model G, class Spacing>
std::vector<surface_sample> sample_surface(const G& model, const Spacing& spacing,
                                           const sampling_limits& limits = {}) {
  return surface_sampler<G, Spacing>(model, spacing, limits).run();
}

} // namespace dovetail::sizing
