/// @file
/// A sizing field of any kind behind one type, with its bounds: what compositions are made of.
#pragma once

#include "dovetail/sizing/bounds.hpp"

#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

namespace dovetail {

/// Holds any sizing field by shared, immutable ownership: copies are cheap. Unlike a bare `any_sizing` it
/// keeps `smallest_size_in`. It converts to `any_sizing`, and comes back out of one with its bounds.
class erased_sizing {
public:
  template <class H>
    requires(!std::same_as<std::remove_cvref_t<H>, erased_sizing>)
  &&sizing_field<std::remove_cvref_t<H>> erased_sizing(H&& field)
      : held_(hold(std::forward<H>(field))) {} // NOLINT: converts, as std::function does

  double operator()(vec3 p) const { return held_->size(p); }
  double smallest_size_in(const box3& box) const { return held_->smallest_size_in(box); }
  double feature_size(vec3 p) const { return held_->feature_size(p); }

private:
  struct interface {
    virtual ~interface() = default;
    virtual double size(vec3 p) const = 0;
    virtual double smallest_size_in(const box3& box) const = 0;
    virtual double feature_size(vec3 p) const = 0;
  };
  template <class H>
  struct model final : interface {
    explicit model(H h) : field(std::move(h)) {}
    double size(vec3 p) const override { return static_cast<double>(field(p)); }
    double smallest_size_in(const box3& box) const override { return dovetail::smallest_size_in(field, box); }
    double feature_size(vec3 p) const override { return dovetail::feature_size(field, p); }
    H field;
  };

  template <class H>
  static std::shared_ptr<const interface> hold(H&& field) {
    using field_type = std::remove_cvref_t<H>;
    if constexpr (std::same_as<field_type, any_sizing>)
      if (const auto* inner = field.template target<erased_sizing>())
        return inner->held_;
    return std::make_shared<model<field_type>>(std::forward<H>(field));
  }

  std::shared_ptr<const interface> held_;
};

/// The lower bound of a run-time field: known when the `any_sizing` was made from an `erased_sizing`.
inline double smallest_size_in(const any_sizing& h, const box3& box) {
  const auto* inner = h.target<erased_sizing>();
  return inner ? inner->smallest_size_in(box) : 0.0;
}

/// The feature size of a run-time field, likewise.
inline double feature_size(const any_sizing& h, vec3 p) {
  const auto* inner = h.target<erased_sizing>();
  return inner ? inner->feature_size(p) : std::numeric_limits<double>::infinity();
}

/// Wraps a field into `any_sizing` so that its lower bounds survive. An empty `any_sizing` stays empty.
template <sizing_field H>
any_sizing keep_bounds(H field) {
  if constexpr (std::same_as<H, any_sizing>)
    return field;
  else
    return any_sizing(erased_sizing(std::move(field)));
}

} // namespace dovetail
