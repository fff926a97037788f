/// @file
/// The optional refinement of `sizing_field`: a lower bound of the size over a box, so that adaptive
/// algorithms (prediction, gradation) cannot miss a small source between their samples; and the checks that
/// every sizing value passes.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <string_view>

namespace dovetail {

/// A sizing field that knows, for every box, a positive lower bound of its values there.
///
/// Valid expression for `const H& h`, `const box3& box`: `h.smallest_size_in(box)`, a double, and those of
/// `sizing_field`.
///
/// Semantics: `h(p) >= h.smallest_size_in(box)` for every p in the box. For a box that shrinks to a point the
/// bound tends to the field's value.
///
/// Complexity: O(log n) for n sources, as an evaluation.
///
/// Failure: never throws; 0 says "unknown".
///
/// Models: source_field, background_field, point_sizes, tabulated_size, graded_size, minimum_of and scaled of
/// such fields, uniform_size.
template <class H>
concept bounded_below_sizing_field = sizing_field<H> && requires(const H& h, const box3& box) {
  { h.smallest_size_in(box) } -> std::convertible_to<double>;
};

/// A lower bound of `h` over the box; 0, "unknown", when the field offers none.
/// Constant time, or what the field takes. Throws nothing of its own.
/// \param h a sizing field
/// \param box corners in the units of the model
template <sizing_field H>
double smallest_size_in(const H& h, const box3& box) {
  if constexpr (bounded_below_sizing_field<H>)
    return h.smallest_size_in(box);
  else
    return 0.0;
}

/// A sizing field that knows the length scale of its own features (sources) at a point.
///
/// Valid expression for `const H& h`, `vec3 p`: `h.feature_size(p)`, a positive double, and those of
/// `sizing_field`.
///
/// Semantics: a mesh whose edges at p are no longer than that cannot step over a feature; infinite where
/// there is none.
///
/// Complexity: O(log n) for n sources, as an evaluation.
///
/// Failure: never throws.
///
/// Models: source_field, point_sizes, tabulated_size; minimum_of and scaled of such fields.
template <class H>
concept feature_aware_sizing_field = sizing_field<H> && requires(const H& h, vec3 p) {
  { h.feature_size(p) } -> std::convertible_to<double>;
};

/// The length beyond which a mesh would step over a feature of `h` near p; infinite when there is none or the
/// field does not know.
/// Constant time, or what the field takes. Throws nothing of its own.
/// \param h a sizing field
/// \param p a point in the units of the model
template <sizing_field H>
double feature_size(const H& h, vec3 p) {
  if constexpr (feature_aware_sizing_field<H>)
    return h.feature_size(p);
  else
    return std::numeric_limits<double>::infinity();
}

/// A sizing field of which only a part counts in a box, so that a field of that part is evaluated faster.
///
/// Valid expression for `const H& h`, `const box3& box`: `h.within(box)`, an H, and those of `sizing_field`.
///
/// Semantics: `h.within(box)(p) == h(p)` for every p in the box, to the last bit; elsewhere nothing is asked
/// of it.
///
/// Complexity: linear in the sources at most; it pays for thousands of evaluations.
///
/// Failure: never throws.
///
/// Models: source_field.
template <class H>
concept narrowable_sizing_field = sizing_field<H> && requires(const H& h, const box3& box) {
  { h.within(box) } -> std::same_as<H>;
};

namespace sizing {

/// Returns `value` when it is positive and finite. Throws `sizing_error` naming `what` otherwise.
inline double checked_size(double value, std::string_view what) {
  if (!(value > 0) || !std::isfinite(value))
    throw sizing_error(std::string(what) + " is " + number_text(value) + "; give a positive, finite number");
  return value;
}

/// Returns `value` when it is zero or positive and finite. Throws `sizing_error` naming `what` otherwise.
inline double checked_length(double value, std::string_view what) {
  if (!(value >= 0) || !std::isfinite(value))
    throw sizing_error(std::string(what) + " is " + number_text(value) +
                       "; give a finite number that is not negative");
  return value;
}

/// Throws `sizing_error` naming `what` unless all coordinates are finite.
inline vec3 checked_point(vec3 p, std::string_view what) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
    throw sizing_error(std::string(what) + " has a coordinate that is not finite");
  return p;
}

} // namespace sizing
} // namespace dovetail
