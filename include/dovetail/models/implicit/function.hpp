/// @file
/// A function of space whose zero set is a surface: gradients, curvature, and projection onto it.
#pragma once

#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace dovetail {

/// The surface value = 0; the body is where the value is negative. `length` is the size of what is looked at:
/// differences are taken over small fractions of it.
class level_set {
public:
  /// Without a gradient, central differences of the value are used.
  level_set(std::function<double(vec3)> value, std::function<vec3(vec3)> gradient, double length)
      : value_(std::move(value)), gradient_(std::move(gradient)), length_(length) {}

  double value(vec3 p) const { return value_(p); } ///< of the function

  /// The function's gradient; by central differences where it is not given.
  vec3 gradient(vec3 p) const {
    if (gradient_)
      return gradient_(p);
    const double h = 1e-5 * length_;
    vec3 g;
    for (int k = 0; k < 3; ++k) {
      vec3 step;
      step[k] = h;
      g[k] = (value_(p + step) - value_(p - step)) / (2 * h);
    }
    return g;
  }

  /// Largest absolute principal curvature of the level through p: the eigenvalues of the gradient's
  /// derivative in the tangent plane over the gradient's length.
  double curvature(vec3 p) const {
    const vec3 g = gradient(p);
    const double steepness = norm(g);
    if (!(steepness > 0))
      return 0;
    const vec3 n = g / steepness;
    const vec3 t = normalized(cross(n, std::abs(n.x) < 0.6 ? vec3{1, 0, 0} : vec3{0, 1, 0}));
    const vec3 s = cross(n, t);
    const double h = 1e-3 * length_;
    const vec3 along_t = (gradient(p + h * t) - gradient(p - h * t)) / (2 * h * steepness);
    const vec3 along_s = (gradient(p + h * s) - gradient(p - h * s)) / (2 * h * steepness);
    const double a = dot(along_t, t), b = 0.5 * (dot(along_t, s) + dot(along_s, t)), c = dot(along_s, s);
    return std::abs(0.5 * (a + c)) + std::hypot(0.5 * (a - c), b);
  }

  /// A point of the surface near p, by Newton steps along the gradient; nothing when these do not arrive
  /// within `reach` of p.
  std::optional<vec3> project(vec3 p, double reach) const {
    return newton(p, reach, [this](vec3 x) -> vec3 {
      const vec3 g = gradient(x);
      const double squared = norm_squared(g);
      return squared > 0 ? (-1 / squared) * g : vec3{};
    });
  }

  /// The point of the surface on the line from p along the unit vector `direction`; nothing when Newton's
  /// steps do not arrive within `reach`, or the line only grazes the surface.
  std::optional<vec3> project_along(vec3 p, vec3 direction, double reach) const {
    return newton(p, reach, [&](vec3 x) -> vec3 {
      constexpr double grazing = 0.05; // cosine between line and normal
      const vec3 g = gradient(x);
      const double slope = dot(g, direction);
      return std::abs(slope) > grazing * norm(g) ? (-1 / slope) * direction : vec3{};
    });
  }

  /// The point of the surface nearest p, started from the surface point `near`: steps along the surface
  /// towards the foot of p, projected again.
  vec3 nearest(vec3 p, vec3 near, double reach) const {
    for (int step = 0; step < most_steps; ++step) {
      const vec3 n = normalized(gradient(near));
      const vec3 away = p - near;
      const vec3 tangential = away - dot(away, n) * n;
      const auto next = project(near + tangential, reach);
      if (!next)
        return near;
      const double moved = distance(*next, near);
      near = *next;
      if (moved <= converged())
        break;
    }
    return near;
  }

private:
  static constexpr int most_steps = 30;

  /// Steps of value(x) * step_per_value(x), shortened where they do not bring the value nearer to zero; a
  /// zero step means that there is no way on.
  template <class StepPerValue>
  std::optional<vec3> newton(vec3 p, double reach, const StepPerValue& step_per_value) const {
    vec3 x = p;
    double v = value_(x);
    for (int step = 0; step < most_steps; ++step) {
      vec3 move = v * step_per_value(x);
      if (v != 0 && move == vec3{})
        return std::nullopt;
      if (norm(move) <= converged())
        return x + move;
      double next = value_(x + move);
      for (int halving = 0; halving < 6 && !(std::abs(next) < std::abs(v)); ++halving) {
        move = 0.5 * move;
        next = value_(x + move);
      }
      x += move;
      v = next;
      if (!(distance(x, p) <= reach))
        return std::nullopt;
    }
    return std::nullopt;
  }

  double converged() const { return 1e-12 * length_; }

  std::function<double(vec3)> value_;
  std::function<vec3(vec3)> gradient_;
  double length_;
};

} // namespace dovetail
