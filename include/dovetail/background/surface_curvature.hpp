/// @file
/// Samples the curvature of a model's faces, as balls that bound the size of its coarse surface mesh.
#pragma once

#include "dovetail/background/surface_size.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/geometry/concepts.hpp"

#include <array>

namespace dovetail::background {

/// How curvature becomes size.
struct curvature_rule {
  double turn = 0.785398163397448; ///< turn of the normal per edge, in radians
  double smallest_fraction = 0.1;  ///< curvature asks for no less than this times the given size
};

/// Collects samples of all faces: on their curves, and inside by halving the parameter rectangle until cells
/// are as small as the size found in them.
template <geometry_model G>
class curvature_sampler {
public:
  curvature_sampler(const G& model, const any_sizing& sizing, const curvature_rule& rule)
      : model_(model), sizing_(sizing), rule_(rule) {}

  std::vector<size_ball> run() {
    const auto& faces = model_.topology().faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      sample_face(static_cast<local_id>(f));
    return std::move(balls_);
  }

private:
  struct sample {
    vec3 point;
    double size;  ///< what curvature asks for
    double given; ///< what the field asks for
  };

  sample sample_at(local_id f, vec2 uv) const {
    const vec3 p = model_.face_point(f, uv);
    const double given = sizing_(p);
    const double curvature = model_.face_curvature(f, uv);
    const double asked = curvature * given > rule_.turn ? rule_.turn / curvature : given;
    return {p, std::max(asked, rule_.smallest_fraction * given), given};
  }
  void keep(const sample& s) {
    if (s.size < s.given)
      balls_.push_back({s.point, 0, s.size});
  }

  void sample_face(local_id f) {
    const auto& face = model_.topology().faces[static_cast<std::size_t>(f)];
    outline_.clear();
    int k = 0;
    for (const auto& loop : face.loops)
      for (const auto& coedge : loop)
        sample_coedge(f, k++, coedge);
    vec2 lower{1e300, 1e300}, upper{-1e300, -1e300};
    for (const auto& [a, b] : outline_) {
      lower = {std::min(lower.x, a.x), std::min(lower.y, a.y)};
      upper = {std::max(upper.x, a.x), std::max(upper.y, a.y)};
    }
    budget_ = 4000;
    sample_cell(f, lower, upper, 0);
  }

  /// Samples along a coedge until neighbours are as near as their size asks; remembers the outline for
  /// inside tests.
  void sample_coedge(local_id f, int k, const geometry_topology::coedge& coedge) {
    const auto& curve = model_.topology().curves[static_cast<std::size_t>(coedge.curve)];
    constexpr int parts = 8;
    vec2 before = model_.curve_uv(f, k, curve.t[coedge.reversed ? 1 : 0]);
    for (int i = 1; i <= parts; ++i) {
      const double s = static_cast<double>(coedge.reversed ? parts - i : i) / parts;
      const vec2 uv = model_.curve_uv(f, k, curve.t[0] + s * (curve.t[1] - curve.t[0]));
      outline_.push_back({before, uv});
      before = uv;
    }
    if (curve.degenerate)
      return;
    const sample first = sample_at(f, model_.curve_uv(f, k, curve.t[0]));
    keep(first);
    double t = curve.t[0];
    sample from = first;
    for (int i = 1; i <= 4; ++i) {
      const double to_t = i == 4 ? curve.t[1] : curve.t[0] + 0.25 * i * (curve.t[1] - curve.t[0]);
      const sample to = sample_at(f, model_.curve_uv(f, k, to_t));
      keep(to);
      sample_between(f, k, t, from, to_t, to, 0);
      t = to_t;
      from = to;
    }
  }
  void sample_between(local_id f, int k, double t0, const sample& a, double t1, const sample& b, int depth) {
    const double least = std::min(a.size, b.size);
    if (depth > 8 || least >= std::min(a.given, b.given) || distance(a.point, b.point) <= 1.5 * least)
      return;
    const double middle = 0.5 * (t0 + t1);
    const sample m = sample_at(f, model_.curve_uv(f, k, middle));
    keep(m);
    sample_between(f, k, t0, a, middle, m, depth + 1);
    sample_between(f, k, middle, m, t1, b, depth + 1);
  }

  void sample_cell(local_id f, vec2 lower, vec2 upper, int depth) {
    if (--budget_ < 0)
      return;
    const vec2 middle = 0.5 * (lower + upper);
    const sample m = sample_at(f, middle);
    if (inside(middle))
      keep(m);
    const vec3 west = model_.face_point(f, {lower.x, middle.y}),
               east = model_.face_point(f, {upper.x, middle.y});
    const vec3 south = model_.face_point(f, {middle.x, lower.y}),
               north = model_.face_point(f, {middle.x, upper.y});
    const double across = distance(west, m.point) + distance(m.point, east);
    const double along = distance(south, m.point) + distance(m.point, north);
    constexpr int always = 3;
    if (depth >= 12 || (depth >= always && (m.size >= m.given || std::max(across, along) <= 1.5 * m.size)))
      return;
    if (across >= along) {
      sample_cell(f, lower, {middle.x, upper.y}, depth + 1);
      sample_cell(f, {middle.x, lower.y}, upper, depth + 1);
    } else {
      sample_cell(f, lower, {upper.x, middle.y}, depth + 1);
      sample_cell(f, {lower.x, middle.y}, upper, depth + 1);
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
  const any_sizing& sizing_;
  curvature_rule rule_;
  std::vector<size_ball> balls_;
  std::vector<std::array<vec2, 2>> outline_;
  int budget_ = 0;
};

/// Balls where curvature asks for a smaller size than `sizing` gives.
template <geometry_model G>
std::vector<size_ball> curvature_balls(const G& model, const any_sizing& sizing, const curvature_rule& rule) {
  return curvature_sampler<G>(model, sizing, rule).run();
}

} // namespace dovetail::background
