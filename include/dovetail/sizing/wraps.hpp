/// @file
/// A sizing field around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/sizing/bounds.hpp"
#include "dovetail/sizing/concepts.hpp"

namespace dovetail::sizing {

/// Base of a sizing field that watches another one: it has the bounds and the features that `Field` has.
/// Whoever changes values has a `smallest_size_in` and a `feature_size` of its own where `Field` has them,
/// since those of `Field` are then not true.
template <class Self, class Field>
struct wraps : wrapped_policy<Self, Field> {
  static_assert(sizing_field<Field>, "sizing::wraps holds a sizing_field (sizing/concepts.hpp)");
  using wrapped_policy<Self, Field>::wrapped_policy;
  using wrapped_policy<Self, Field>::wrapped;

  /// The size by the wrapped field.
  double operator()(vec3 p) const { return wrapped(p); }
  double smallest_size_in(const box3& box) const requires bounded_below_sizing_field<Field> {
    return wrapped.smallest_size_in(box);
  }
  double feature_size(vec3 p) const requires feature_aware_sizing_field<Field> {
    return wrapped.feature_size(p);
  }
  /// The part of the wrapped field that counts in the box, wrapped.
  Self within(const box3& box) const requires narrowable_sizing_field<Field> {
    return this->around(wrapped.within(box));
  }
};

} // namespace dovetail::sizing
