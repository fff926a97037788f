/// @file
/// What every `geometry_model` must satisfy, checked by samples; returns the faults as sentences.
#pragma once

#include "dovetail/geometry/concepts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace dovetail::testing {

/// Whether numbers may stand for nothing: faces without loops, degenerate curves without coedges.
enum class absence { none, of_faces };

template <geometry_model G>
class model_checks {
public:
  explicit model_checks(const G& model, absence allowed = absence::none)
      : model_(model), topology_(model.topology()), allowed_(allowed),
        is_used_(topology_.curves.size(), false) {
    for (const auto& face : topology_.faces)
      for (const auto& coedge : face.coedges)
        is_used_[coedge.curve] = true;
  }

  std::vector<std::string> faults() {
    for (std::size_t c = 0; c < topology_.curves.size(); ++c)
      if (allowed_ == absence::none || is_used_[c] || !topology_.curves[c].degenerate)
        check_curve(static_cast<local_id>(c));
    for (std::size_t f = 0; f < topology_.faces.size(); ++f) {
      if (allowed_ == absence::of_faces && topology_.faces[f].loops.empty())
        continue;
      check_loops(static_cast<local_id>(f));
      check_parameter_curves(static_cast<local_id>(f));
      check_projection(static_cast<local_id>(f));
    }
    for (std::size_t s = 0; s < topology_.solids.size(); ++s)
      check_closed(static_cast<local_id>(s));
    return std::move(faults_);
  }

private:
  static constexpr int samples = 33;

  void complain(const std::string& kind, local_id id, const std::string& what) {
    faults_.push_back(kind + " " + std::to_string(id) + " " + what);
  }

  void check_curve(local_id c) {
    const auto& curve = topology_.curves[c];
    if (!(curve.t[0] < curve.t[1]))
      complain("curve", c, "has an empty parameter range");
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& vertex = topology_.vertices[curve.vertices[end]];
      const double gap = distance(model_.curve_point(c, curve.t[end]), vertex.point);
      if (gap > vertex.tolerance + curve.tolerance + rounding())
        complain("curve", c, "ends " + std::to_string(gap) + " away from its vertex");
    }
    if (curve.degenerate)
      return;
    for (int i = 1; i < 8; ++i) {
      const double t = parameter(curve, i / 8.0);
      const double width = curve.t[1] - curve.t[0];
      const vec3 p = model_.curve_point(c, t);
      const double found = model_.project_to_curve(c, p, t + 0.01 * width);
      if (distance(model_.curve_point(c, found), p) > rounding())
        complain("curve", c, "is not found again by projection");
    }
  }

  static double parameter(const geometry_topology::curve& curve, double s) {
    return s < 1 ? curve.t[0] + s * (curve.t[1] - curve.t[0]) : curve.t[1];
  }
  static double along(const geometry_topology::curve& curve, bool reversed, double s) {
    return parameter(curve, reversed ? 1 - s : s);
  }

  /// The sampled loop; `offset` is the index of its first coedge.
  std::vector<vec2> polygon(local_id f, std::size_t offset, std::size_t count) const {
    const auto& face = topology_.faces[f];
    std::vector<vec2> points;
    for (std::size_t k = offset; k < offset + count; ++k) {
      const auto& coedge = face.coedges[k];
      const auto& curve = topology_.curves[coedge.curve];
      for (int i = 0; i < samples; ++i)
        points.push_back(
            model_.curve_uv(f, static_cast<int>(k), along(curve, coedge.reversed, double(i) / samples)));
    }
    return points;
  }

  void check_loops(local_id f) {
    const auto& face = topology_.faces[f];
    std::size_t offset = 0;
    int outer = 0;
    std::vector<vec2> all;
    for (const auto& loop : face.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::size_t here = offset + k, next = offset + (k + 1) % loop.size();
        const vec2 gap = end_uv(f, here, 1) - end_uv(f, next, 0);
        if (norm(gap) > 1e-9 * (1 + norm(end_uv(f, here, 1))))
          complain("face", f, "has a loop that is open in the parameter plane");
      }
      const std::vector<vec2> points = polygon(f, offset, loop.size());
      double twice = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        twice += cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
      outer += twice > 0 ? 1 : 0;
      all.insert(all.end(), points.begin(), points.end());
      offset += loop.size();
    }
    if (outer != 1)
      complain("face", f, "has " + std::to_string(outer) + " outer loops");
    if (offset != face.coedges.size())
      complain("face", f, "lists other coedges than its loops do");
  }

  vec2 end_uv(local_id f, std::size_t k, double s) const {
    const auto& coedge = topology_.faces[f].coedges[k];
    const auto& curve = topology_.curves[coedge.curve];
    return model_.curve_uv(f, static_cast<int>(k), along(curve, coedge.reversed, s));
  }

  void check_parameter_curves(local_id f) {
    const auto& face = topology_.faces[f];
    for (std::size_t k = 0; k < face.coedges.size(); ++k) {
      const auto& curve = topology_.curves[face.coedges[k].curve];
      double worst = 0;
      for (int i = 0; i <= samples; ++i) {
        const double t = parameter(curve, double(i) / samples);
        const vec3 on_face = model_.face_point(f, model_.curve_uv(f, static_cast<int>(k), t));
        const double at_vertex = i == 0         ? topology_.vertices[curve.vertices[0]].tolerance
                                 : i == samples ? topology_.vertices[curve.vertices[1]].tolerance
                                                : 0;
        worst = std::max(worst, distance(on_face, model_.curve_point(face.coedges[k].curve, t)) - at_vertex);
      }
      const double allowed = curve.tolerance + pole_tolerance(curve) + rounding();
      if (worst > 1.5 * allowed)
        complain("face", f,
                 "departs by " + std::to_string(worst) + " from curve " +
                     std::to_string(face.coedges[k].curve) + " of tolerance " +
                     std::to_string(curve.tolerance));
    }
  }
  double pole_tolerance(const geometry_topology::curve& curve) const {
    return curve.degenerate ? topology_.vertices[curve.vertices[0]].tolerance : 0;
  }

  /// A point of the face is found again from a seed nearby.
  void check_projection(local_id f) {
    const auto& face = topology_.faces[f];
    vec2 lower{1e300, 1e300}, upper{-1e300, -1e300};
    for (const vec2 p : polygon(f, 0, face.coedges.size())) {
      lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
      upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
    }
    const vec2 width = upper - lower;
    for (int i = 1; i < 6; ++i) {
      for (int j = 1; j < 6; ++j) {
        const vec2 uv{lower.x + width.x * i / 6, lower.y + width.y * j / 6};
        const vec3 p = model_.face_point(f, uv);
        const vec2 seed{uv.x + 0.02 * width.x, uv.y - 0.015 * width.y};
        const vec2 found = model_.project_to_face(f, p, seed);
        const double miss = distance(model_.face_point(f, found), p);
        if (miss > rounding() + 1e-6 * distance(model_.face_point(f, seed), p))
          complain("face", f, "is not found again by projection, off by " + std::to_string(miss));
        const double curvature = model_.face_curvature(f, uv);
        if (!(curvature >= 0) || !std::isfinite(curvature))
          complain("face", f, "has no finite curvature");
      }
    }
  }

  void check_closed(local_id solid) {
    std::vector<int> balance(topology_.curves.size(), 0), passages(topology_.curves.size(), 0);
    for (const auto& face : topology_.faces) {
      for (std::size_t side = 0; side < 2; ++side) {
        if (face.solids[side] != solid)
          continue;
        for (const auto& coedge : face.coedges) {
          const bool backwards = (coedge.reversed != face.reversed) != (side == 1);
          balance[coedge.curve] += backwards ? -1 : 1;
          passages[coedge.curve] += 1;
        }
      }
    }
    for (std::size_t c = 0; c < balance.size(); ++c)
      if (!topology_.curves[c].degenerate && (balance[c] != 0 || passages[c] % 2 != 0))
        complain("solid", solid, "is not closed at curve " + std::to_string(c));
  }

  double rounding() const { return 1e-9 * model_.bounds().diagonal(); }

  const G& model_;
  const geometry_topology& topology_;
  absence allowed_;
  std::vector<bool> is_used_; ///< by curve
  std::vector<std::string> faults_;
};

template <geometry_model G>
std::vector<std::string> faults_of(const G& model, absence allowed = absence::none) {
  return model_checks<G>(model, allowed).faults();
}

} // namespace dovetail::testing
