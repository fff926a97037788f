/// @file
/// Functions for `implicit_model`: a few shapes, negative inside, and smooth ways to combine them. All are
/// plain callables, so any lambda mixes with them.
#pragma once

#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <vector>

namespace dovetail::implicit {

/// Signed distance from a sphere.
struct sphere {
  vec3 center = {};                                                        ///< the middle
  double radius = 1;                                                       ///< of the sphere
  double operator()(vec3 p) const { return distance(p, center) - radius; } ///< the distance, negative inside
};

/// Signed distance from a torus around the z axis through `center`.
struct torus {
  vec3 center = {};
  double large_radius = 1;   ///< from the axis to the middle of the tube
  double small_radius = 0.3; ///< of the tube
  /// The distance, negative inside.
  double operator()(vec3 p) const {
    const vec3 q = p - center;
    return std::hypot(std::hypot(q.x, q.y) - large_radius, q.z) - small_radius;
  }
};

/// Signed distance from a box whose edges and corners are rounded.
struct rounded_box {
  vec3 center = {};          ///< the middle
  vec3 half_widths{1, 1, 1}; ///< half the width along each axis
  double rounding = 0.1;     ///< at most the smallest half width
  /// The distance, negative inside.
  double operator()(vec3 p) const {
    vec3 outside;
    double nearest_plane = -1e300;
    for (int k = 0; k < 3; ++k) {
      const double beyond = std::abs(p[k] - center[k]) - (half_widths[k] - rounding);
      outside[k] = std::max(beyond, 0.0);
      nearest_plane = std::max(nearest_plane, beyond);
    }
    return norm(outside) + std::min(nearest_plane, 0.0) - rounding;
  }
};

/// A sheet around Schoen's gyroid, of about the given thickness.
struct gyroid {
  double period = 1;      ///< after which it repeats itself
  double thickness = 0.2; ///< of the sheet
  /// About the distance, negative inside the sheet.
  double operator()(vec3 p) const {
    const double k = 2 * 3.14159265358979323846 / period;
    const double g = std::sin(k * p.x) * std::cos(k * p.y) + std::sin(k * p.y) * std::cos(k * p.z) +
                     std::sin(k * p.z) * std::cos(k * p.x);
    // |gradient| is about 1.5 k on the gyroid; the root is smooth where g changes its sign.
    const double half = 0.5 * thickness * 1.5 * k;
    return (g * g - half * half) / (2 * half * 1.5 * k);
  }
};

/// Balls that flow together: sum of (radius / distance)^2 above 1. J. F. Blinn's blobs, with another law.
struct metaballs {
  std::vector<sphere> balls; ///< which flow together
  /// Negative inside.
  double operator()(vec3 p) const {
    double sum = 0;
    double largest = 1e-300;
    for (const sphere& b : balls) {
      sum += b.radius * b.radius / std::max(norm_squared(p - b.center), 1e-12 * b.radius * b.radius);
      largest = std::max(largest, b.radius);
    }
    return largest * (1 / std::sqrt(std::max(sum, 1e-300)) - 1);
  }
};

/// Where both bodies are, with edges rounded over about `rounding`: a smooth maximum, polynomial of third
/// degree between the two.
template <std::invocable<vec3> A, std::invocable<vec3> B>
auto intersection(A a, B b, double rounding) {
  return [a, b, rounding](vec3 p) {
    const double x = a(p);
    const double y = b(p);
    const double near = std::max(rounding - std::abs(x - y), 0.0) / rounding;
    return std::max(x, y) + near * near * near * rounding / 6;
  };
}

/// Where any of the bodies is, rounded.
/// \param rounding how far from their seam shapes are blended, > 0
template <std::invocable<vec3> A, std::invocable<vec3> B>
auto united(A a, B b, double rounding) {
  const auto outside = [](auto f) { return [f](vec3 p) { return -f(p); }; };
  return outside(intersection(outside(a), outside(b), rounding));
}

/// The first without the second, rounded.
/// \param rounding how far from their seam shapes are blended, > 0
template <std::invocable<vec3> A, std::invocable<vec3> B>
auto difference(A a, B b, double rounding) {
  return intersection(
      a, [b](vec3 p) { return -b(p); }, rounding);
}

} // namespace dovetail::implicit
