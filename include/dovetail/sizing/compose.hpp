/// @file
/// Fields made of other fields: minimum, scaling, clamping.
#pragma once

#include "dovetail/core/number_text.hpp"
#include "dovetail/sizing/erased.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace dovetail {

/// The smallest of several fields at each point. Throws `sizing_error` when there is none.
class minimum_of {
public:
  explicit minimum_of(std::vector<erased_sizing> fields) : fields_(std::move(fields)) {
    if (fields_.empty())
      throw sizing_error("the minimum of no sizing field is undefined; give at least one");
  }
  template <class First, class... Rest>
    requires(!std::same_as<First, minimum_of>)
  explicit minimum_of(First first, Rest... rest)
      : minimum_of(list_of(std::move(first), std::move(rest)...)) {}

  double operator()(vec3 p) const {
    double least = fields_.front()(p);
    for (std::size_t i = 1; i < fields_.size(); ++i)
      least = std::min(least, fields_[i](p));
    return least;
  }
  /// 0 (unknown) as soon as one of the fields has no bound.
  double smallest_size_in(const box3& box) const {
    double least = fields_.front().smallest_size_in(box);
    for (std::size_t i = 1; i < fields_.size(); ++i)
      least = std::min(least, fields_[i].smallest_size_in(box));
    return least;
  }

  double feature_size(vec3 p) const {
    double least = fields_.front().feature_size(p);
    for (std::size_t i = 1; i < fields_.size(); ++i)
      least = std::min(least, fields_[i].feature_size(p));
    return least;
  }

private:
  template <class... Fields>
  static std::vector<erased_sizing> list_of(Fields... fields) {
    constexpr bool are_fields = (sizing_field<Fields> && ...);
    static_assert(are_fields, "minimum_of takes models of sizing_field (sizing/concepts.hpp)");
    if constexpr (are_fields)
      return {std::move(fields)...};
  }

  std::vector<erased_sizing> fields_;
};

/// A field times a constant factor. Throws `sizing_error` for a factor that is not positive and finite.
template <class H>
class scaled {
  static_assert(sizing_field<H>, "scaled takes a sizing_field (sizing/concepts.hpp)");

public:
  scaled(H field, double factor)
      : field_(std::move(field)), factor_(sizing::checked_size(factor, "the scaling factor")) {}

  double operator()(vec3 p) const { return factor_ * field_(p); }
  double smallest_size_in(const box3& box) const { return factor_ * dovetail::smallest_size_in(field_, box); }
  double feature_size(vec3 p) const { return dovetail::feature_size(field_, p); }

private:
  H field_;
  double factor_;
};

/// A field clamped to [lower, upper]. Throws `sizing_error` unless 0 < lower <= upper, both finite.
template <class H>
class bounded {
  static_assert(sizing_field<H>, "bounded takes a sizing_field (sizing/concepts.hpp)");

public:
  bounded(H field, double lower, double upper)
      : field_(std::move(field)), lower_(sizing::checked_size(lower, "the lower size bound")),
        upper_(sizing::checked_size(upper, "the upper size bound")) {
    if (lower > upper)
      throw sizing_error("the lower size bound " + number_text(lower) + " exceeds the upper one " +
                         number_text(upper) + "; exchange them");
  }

  double operator()(vec3 p) const { return std::clamp(static_cast<double>(field_(p)), lower_, upper_); }
  /// Unknown (0) when the field's is: `lower` alone would be a bound that never gets sharp.
  double smallest_size_in(const box3& box) const {
    const double least = dovetail::smallest_size_in(field_, box);
    return least > 0 ? std::clamp(least, lower_, upper_) : 0.0;
  }
  /// What the field that is clamped says.
  double feature_size(vec3 p) const { return dovetail::feature_size(field_, p); }

private:
  H field_;
  double lower_;
  double upper_;
};

} // namespace dovetail
