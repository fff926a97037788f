/// @file
/// A curve of a plane domain.
#pragma once

#include "dovetail/core/vector.hpp"

#include <cstddef>
#include <vector>

namespace dovetail {

/// A plane curve of straight parts, by arc length.
class polyline {
public:
  explicit polyline(std::vector<vec2> points);

  double length() const { return until_.back(); } ///< of all its parts
  /// The point at length `t` from the start.
  vec2 at(double t) const;
  /// Unit vector along the part at t.
  vec2 direction(double t) const;
  /// The parameter of the nearest point that a walk from `seed` downhill finds.
  double nearest(vec2 p, double seed) const;

private:
  std::size_t part(double t) const;
  double on_part(std::size_t i, vec2 p) const;

  std::vector<vec2> points_;
  std::vector<double> until_; ///< arc length up to each point
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/plane/polyline.ipp"
#endif
