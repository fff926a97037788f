/// @file
/// The size at a point for algorithms that cannot work with an unusable one.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <cmath>
#include <string>

namespace dovetail {

/// A size that a mesher can work with, or `sizing_error` naming the place.
inline double checked_size(const any_sizing& size, vec3 p) {
  const double h = size(p);
  if (!(h > 0) || !std::isfinite(h))
    throw sizing_error("the size at (" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " +
                       std::to_string(p.z) + ") is " + std::to_string(h) +
                       "; it must be positive and finite");
  return h;
}

} // namespace dovetail
