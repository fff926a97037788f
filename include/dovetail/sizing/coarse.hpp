/// @file
/// The sizing field of the background mesh: the user's field, scaled up as far as it goes without harm.
#pragma once

#include "dovetail/core/number_text.hpp"
#include "dovetail/sizing/erased.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace dovetail {

/// min(scale * h, the radius of the sources in reach, box diagonal / 10), but never below h itself.
/// Blind scaling would make coarse elements that step over a source and so never see it. (The bound by
/// surface curvature is the coarse surface mesher's.) Throws `sizing_error` for a scale below 1 and for an
/// empty box.
template <sizing_field H>
class coarse_size {
public:
  coarse_size(H fine, double scale, const box3& domain, double largest_fraction_of_diagonal = 0.1)
      : fine_(std::move(fine)), scale_(sizing::checked_size(scale, "the factor of the coarse size")),
        largest_(sizing::checked_size(largest_fraction_of_diagonal * domain.diagonal(),
                                      "the largest coarse size, a fraction of the model's diagonal,")) {
    if (scale < 1)
      throw sizing_error("the factor of the coarse size is " + number_text(scale) + "; give 1 or more");
  }

  /// The size at a point.
  double operator()(vec3 p) const {
    const double fine = fine_(p);
    return std::max(fine, std::min({scale_ * fine, 2 * dovetail::feature_size(fine_, p), largest_}));
  }
  /// A lower bound over a box.
  double smallest_size_in(const box3& box) const { return dovetail::smallest_size_in(fine_, box); }

private:
  H fine_;
  double scale_;
  double largest_;
};

} // namespace dovetail
