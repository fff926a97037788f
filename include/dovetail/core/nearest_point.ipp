/// @file
/// What `nearest_point.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <array>

namespace dovetail {

DOVETAIL_INLINE std::array<double, 2> nearest_on_segment(vec3 a, vec3 b, vec3 p) {
  const vec3 along = b - a;
  const double length_squared = norm_squared(along);
  const double s = length_squared > 0 ? std::clamp(dot(p - a, along) / length_squared, 0.0, 1.0) : 0.0;
  return {1 - s, s};
}

DOVETAIL_INLINE std::array<double, 3> nearest_on_triangle(vec3 a, vec3 b, vec3 c, vec3 p) {
  const vec3 ab = b - a;
  const vec3 ac = c - a;
  const vec3 ap = p - a;
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0)
    return {1, 0, 0};
  const vec3 bp = p - b;
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3)
    return {0, 1, 0};
  const vec3 cp = p - c;
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6)
    return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 > d3 ? d1 / (d1 - d3) : 0.0;
    return {1 - s, s, 0};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 > d6 ? d2 / (d2 - d6) : 0.0;
    return {1 - s, 0, s};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double run = (d4 - d3) + (d5 - d6);
    const double s = run > 0 ? (d4 - d3) / run : 0.0;
    return {0, 1 - s, s};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

} // namespace dovetail
