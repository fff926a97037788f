/// @file
/// A sizing field of any kind behind one type, with its bounds: what compositions are made of.
#pragma once

#include "dovetail/core/box_tree.hpp"
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
  /// What the field that it holds says; infinite when that knows of none.
  double feature_size(vec3 p) const { return held_->feature_size(p); }
  /// The same field everywhere, evaluated faster in a box where it is a `narrowable_sizing_field`.
  erased_sizing faster_in(const box3& box) const {
    auto narrow = held_->narrowed(box);
    return narrow ? erased_sizing(std::move(narrow)) : *this;
  }

private:
  struct interface : std::enable_shared_from_this<interface> {
    virtual ~interface() = default;
    virtual std::shared_ptr<const interface> narrowed(const box3& box) const = 0; ///< or none
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
    std::shared_ptr<const interface> narrowed(const box3& box) const override {
      if constexpr (narrowable_sizing_field<H>)
        return std::make_shared<narrow_model<H>>(field.within(box), box, this->shared_from_this());
      else
        return nullptr;
    }
    H field;
  };
  /// The field of a box, and the whole one for all that is not in it.
  template <class H>
  struct narrow_model final : interface {
    narrow_model(H narrow, const box3& where, std::shared_ptr<const interface> everywhere)
        : part(std::move(narrow)), box(where), whole(std::move(everywhere)) {}
    double size(vec3 p) const override { return contains(box, p) ? part(p) : whole->size(p); }
    double smallest_size_in(const box3& where) const override { return whole->smallest_size_in(where); }
    double feature_size(vec3 p) const override { return whole->feature_size(p); }
    std::shared_ptr<const interface> narrowed(const box3& where) const override {
      return whole->narrowed(where);
    }
    H part;
    box3 box;
    std::shared_ptr<const interface> whole;
  };

  explicit erased_sizing(std::shared_ptr<const interface> held) : held_(std::move(held)) {}

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

/// The same field, evaluated faster in a box if it can be; for thousands of evaluations there.
inline any_sizing faster_in(const any_sizing& h, const box3& box) {
  const auto* inner = h.target<erased_sizing>();
  return inner ? any_sizing(inner->faster_in(box)) : h;
}

/// Wraps a field into `any_sizing` so that its lower bounds survive. An empty `any_sizing` stays empty.
/// Constant time. Throws nothing but for a lack of memory.
/// \param field a sizing field, which is moved
template <sizing_field H>
any_sizing keep_bounds(H field) {
  if constexpr (std::same_as<H, any_sizing>)
    return field;
  else
    return any_sizing(erased_sizing(std::move(field)));
}

} // namespace dovetail
