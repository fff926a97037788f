/// @file
/// The size at a point for algorithms that cannot work with an unusable one.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/erased.hpp"

#include <cmath>
#include <string>

namespace dovetail {

/// A size that a mesher can work with, or `sizing_error` naming the place.
template <sizing_field H>
double checked_size(const H& size, vec3 p) {
  const auto who = [&] {
    return "the size at (" + number_text(p.x) + ", " + number_text(p.y) + ", " + number_text(p.z) + ")";
  };
  const double h = call_policy<sizing_error>(who, [&] { return static_cast<double>(size(p)); });
  if (!(h > 0) || !std::isfinite(h))
    throw sizing_error(who() + " is " + number_text(h) + "; it must be positive and finite");
  return h;
}

/// A field whose every value is looked at: what is said of a bad one then names its place, and not what came
/// of it.
struct checked_sizing {
  erased_sizing field; ///< the field that is looked at
  /// Its size at a point. Throws `sizing_error` that names the point when the size is not positive and
  /// finite.
  double operator()(vec3 p) const { return checked_size(field, p); }
  /// What the field says.
  double smallest_size_in(const box3& box) const { return field.smallest_size_in(box); }
  double feature_size(vec3 p) const { return field.feature_size(p); } ///< that of the field
};

} // namespace dovetail
