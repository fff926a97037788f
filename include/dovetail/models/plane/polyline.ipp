/// @file
/// What `polyline.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/plane/polyline.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE polyline::polyline(std::vector<vec2> points) : points_(std::move(points)), until_{0} {
  for (std::size_t i = 1; i < points_.size(); ++i)
    until_.push_back(until_.back() + norm(points_[i] - points_[i - 1]));
}

DOVETAIL_INLINE vec2 polyline::at(double t) const {
  const std::size_t i = part(t);
  if (t <= until_[i])
    return points_[i];
  if (t >= until_[i + 1])
    return points_[i + 1];
  const double s = (t - until_[i]) / (until_[i + 1] - until_[i]);
  return (1 - s) * points_[i] + s * points_[i + 1];
}

DOVETAIL_INLINE vec2 polyline::direction(double t) const {
  const std::size_t i = part(t);
  return (1 / (until_[i + 1] - until_[i])) * (points_[i + 1] - points_[i]);
}

DOVETAIL_INLINE double polyline::nearest(vec2 p, double seed) const {
  std::size_t i = part(seed);
  double best = on_part(i, p);
  for (bool moved = true; moved;) {
    moved = false;
    for (const std::size_t next : {i == 0 ? i : i - 1, i + 2 < points_.size() ? i + 1 : i})
      if (const double t = on_part(next, p); norm(at(t) - p) < norm(at(best) - p)) {
        best = t;
        i = next;
        moved = true;
      }
  }
  return best;
}

DOVETAIL_INLINE std::size_t polyline::part(double t) const {
  const auto after = std::upper_bound(until_.begin() + 1, until_.end() - 1, t);
  return static_cast<std::size_t>(after - until_.begin()) - 1;
}

DOVETAIL_INLINE double polyline::on_part(std::size_t i, vec2 p) const {
  const double length = until_[i + 1] - until_[i];
  const vec2 along = (1 / length) * (points_[i + 1] - points_[i]);
  return until_[i] + std::clamp(dot(p - points_[i], along), 0.0, length);
}

} // namespace dovetail
