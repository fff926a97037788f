/// @file
/// The sizing field of the background mesh: the user's field, scaled up as far as it goes without harm.
#pragma once

#include "dovetail/core/number_text.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/point_sizes.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// min(scale * h, the radius of the sources in reach, sizes in walls, box diagonal / 10), but never below h
/// itself. Blind scaling would make coarse elements that step over a source and so never see it, and flat
/// ones in thin walls. (The bound by surface curvature is the coarse surface mesher's.) Throws `sizing_error`
/// for a scale below 1 and for an empty box.
template <sizing_field H>
class coarse_size {
public:
  /// \param walls sizes at points of walls, from where they grow (`sizing::coarse_sizes_in_walls`)
  coarse_size(H fine, double scale, const box3& domain, const std::vector<sized_point>& walls = {})
      : fine_(std::move(fine)), scale_(sizing::checked_size(scale, "the factor of the coarse size")),
        largest_(sizing::checked_size(0.1 * domain.diagonal(),
                                      "the largest coarse size, a tenth of the model's diagonal,")) {
    constexpr double growth = 0.5;
    if (!walls.empty())
      in_walls_.emplace(walls, growth, largest_);
    if (scale < 1)
      throw sizing_error("the factor of the coarse size is " + number_text(scale) + "; give 1 or more");
  }

  /// The size at a point.
  double operator()(vec3 p) const {
    const double fine = fine_(p);
    const double in_walls = in_walls_ ? (*in_walls_)(p) : largest_;
    return std::max(fine,
                    std::min({scale_ * fine, 2 * dovetail::feature_size(fine_, p), in_walls, largest_}));
  }
  /// A lower bound over a box.
  double smallest_size_in(const box3& box) const { return dovetail::smallest_size_in(fine_, box); }

private:
  H fine_;
  double scale_;
  double largest_;
  std::optional<point_sizes> in_walls_;
};

} // namespace dovetail
