/// @file
/// The plane that a chart is projected onto, and principal axes.
#pragma once

#include "dovetail/core/vector.hpp"

#include <array>
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
chart_frame frame_along(vec3 origin, vec3 normal);

/// Weighted second moments of vectors about their mean.
class vector_moments {
public:
  /// One vector with its weight.
  void add(vec3 a, double weight) {
    weight_ += weight;
    sum_ += weight * a;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        squares_[3 * i + j] += weight * a[i] * a[j];
  }
  /// The weighted mean of the vectors; 0 without any.
  vec3 mean() const { return weight_ > 0 ? sum_ / weight_ : sum_; }

  /// The direction in which the vectors spread most, by 64 steps of the power method from a fixed start.
  vec3 principal_axis() const;

private:
  double weight_ = 0;
  vec3 sum_;
  std::array<double, 9> squares_{};
};

} // namespace dovetail::discrete

#ifndef DOVETAIL_COMPILED
#include "dovetail/geometry/frame.ipp"
#endif
