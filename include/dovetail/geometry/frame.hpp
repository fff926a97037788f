/// @file
/// The plane that a chart is projected onto, and principal axes.
#pragma once

#include "dovetail/core/vector.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace dovetail::discrete {

/// An orthonormal, right-handed frame: parameters are coordinates along `u` and `v` from `origin`, heights
/// along `n`.
struct chart_frame {
  vec3 origin;
  vec3 u{1, 0, 0};
  vec3 v{0, 1, 0};
  vec3 n{0, 0, 1};

  /// The parameters of the point below `p`.
  vec2 flat(vec3 p) const { return {dot(p - origin, u), dot(p - origin, v)}; }
};

/// The frame with a given normal; u leans on the coordinate axis least along it.
inline chart_frame frame_along(vec3 origin, vec3 normal) {
  const vec3 n = normalized(normal);
  const vec3 size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  const vec3 axis = size.x <= size.y && size.x <= size.z ? vec3{1, 0, 0}
                    : size.y <= size.z                   ? vec3{0, 1, 0}
                                                         : vec3{0, 0, 1};
  const vec3 u = normalized(axis - dot(axis, n) * n);
  return {origin, u, cross(n, u), n};
}

/// Weighted second moments of vectors about their mean.
class vector_moments {
public:
  /// One vector with its weight.
  void add(vec3 a, double weight) {
    weight_ += weight;
    sum_ += weight * a;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        squares_[static_cast<std::size_t>(3 * i + j)] += weight * a[i] * a[j];
  }
  /// The weighted mean of the vectors; 0 without any.
  vec3 mean() const { return weight_ > 0 ? sum_ / weight_ : sum_; }

  /// The direction in which the vectors spread most, by 64 steps of the power method from a fixed start.
  vec3 principal_axis() const {
    const vec3 m = mean();
    vec3 axis = normalized({0.5773, 0.6131, 0.5391});
    for (int step = 0; step < 64; ++step) {
      vec3 next;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          next[i] += (squares_[static_cast<std::size_t>(3 * i + j)] - weight_ * m[i] * m[j]) * axis[j];
      if (!(norm(next) > 0))
        return axis;
      axis = normalized(next);
    }
    return axis;
  }

private:
  double weight_ = 0;
  vec3 sum_;
  std::array<double, 9> squares_{};
};

} // namespace dovetail::discrete
