/// @file
/// What a sizing field is, and one chosen at run time.
#pragma once

#include "dovetail/core/vector.hpp"

#include <concepts>
#include <functional>

namespace dovetail {

/// The role `sizing_field`: position -> target edge length.
///
/// Valid expression for `const H& h`, `vec3 p`: `h(p)`, a positive finite double in the unit of the model.
///
/// Semantics: pure; the same point always gives the same value. Callable from several threads at once.
///
/// Complexity: O(log n) for n sources.
///
/// Failure: construction throws `sizing_error`, evaluation never throws.
///
/// Models: uniform_size, source_field, background_field, point_sizes (curvature, proximity), tabulated_size
/// (automatic), minimum_of, scaled, graded_size, any_sizing, a user's lambda.
template <class H>
concept sizing_field = std::copy_constructible<H> && requires(const H& h, vec3 p) {
  { h(p) } -> std::convertible_to<double>;
};

/// A sizing field chosen at run time; any model of `sizing_field` converts to it.
using any_sizing = std::function<double(vec3)>;

} // namespace dovetail
