/// @file
/// What a detail of a model is to which sizes are fitted, and what that costs.
#pragma once

#include "dovetail/sizing/point_sizes.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace dovetail {

/// Which details sizes are to fit, and how far that goes.
struct kept_detail_options {
  /// Up to this share of the size there a length is a detail's, and up to twice that the width of a strip; at
  /// most 1.
  double share_of_size = 0.25;
  double touching_share = 0.001; ///< vertices nearer to a curve than this share of the size are on it
  double least_size = 0;         ///< no size becomes smaller, nor than `touching_share` of what it was
  double growth = 0.4;           ///< of the size per length away from details
  double most_elements = 2e5;    ///< details that need more, about, stay as they are, the costly ones first
  int dimension = 3;             ///< of the elements
};

namespace sizing {

/// About how many elements a size that grows from a place on a surface makes more than the one that it grows
/// to: the integral of the inverse cube over half a ball, or of the inverse square over a disk, of which a
/// plane domain has only half. O(1), throws nothing.
/// \param from the size at the place
/// \param to the size that it grows to; larger
/// \param growth of the size per length
/// \param dimension of the elements, 3 or 2
inline double elements_of_growth(double from, double to, double growth, int dimension = 3) {
  const double share = from / to, reached = 1 - share;
  if (dimension == 2) {
    constexpr double per_square = 4 / std::numbers::sqrt3; // of regular triangles
    const double inside = -std::log(share) - reached, before = reached * reached / 2;
    return per_square * 2 * std::numbers::pi * (inside - before) / (growth * growth);
  }
  constexpr double per_cube = 6 * std::numbers::sqrt2; // of regular tetrahedra
  const double inside = -std::log(share) + 2 * share - 0.5 * share * share - 1.5;
  const double before = reached * reached * reached / 3;
  return per_cube * 2 * std::numbers::pi * (inside - before) / std::pow(growth, 3);
}

/// The same along a line on a surface, per length of it: where a size grows away from all of its points.
/// \param from the size on the line
/// \param to the size that it grows to; larger
/// \param growth of the size per length
/// \param dimension of the elements, 3 or 2
inline double elements_of_growth_along(double from, double to, double growth, int dimension = 3) {
  const double reach = (to - from) / growth;
  if (dimension == 2) {
    constexpr double per_square = 4 / std::numbers::sqrt3;
    const double inside = (1 / from - 1 / to) / growth, before = reach / (to * to);
    return per_square * 2 * (inside - before);
  }
  constexpr double per_cube = 6 * std::numbers::sqrt2;
  const double inside = (0.5 / from - 1 / to + 0.5 * from / (to * to)) / (growth * growth);
  const double before = 0.5 * reach * reach / (to * to * to);
  return per_cube * std::numbers::pi * (inside - before);
}

/// A detail that sizes are to fit.
struct kept_detail {
  std::vector<sized_point> places; ///< how small they should be where
  double elements = 0;             ///< about how many elements fitting it adds
};

} // namespace sizing

} // namespace dovetail
