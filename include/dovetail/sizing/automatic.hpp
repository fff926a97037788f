/// @file
/// Sizes from a CAD model alone: curvature, proximity and limited growth together, after the idea of J. Chen,
/// Z. Xiao, Y. Zheng, J. Zheng, C. Li and K. Liang, "Automatic sizing functions for unstructured surface mesh
/// generation" (2017): sizes are found at points of the model and then limited in their growth.
#pragma once

#include "dovetail/sizing/proximity.hpp"
#include "dovetail/sizing/tabulated.hpp"

#include <vector>

namespace dovetail {

/// What a size from the model goes by. Lengths are in the model's unit.
struct automatic_options {
  double elements_per_circle = 24; ///< 0: curvature does not count
  double elements_across = 2;      ///< of walls and gaps; 0: proximity does not count
  double least_in_walls = 0;       ///< down to there sizes of thin walls may be below the smallest; 0: none
  bool inside = true;              ///< thin walls
  bool outside = false;            ///< gaps between faces
  model_size_range range = {};     ///< no size is outside of it, but for thin walls
};

/// Sizes in walls thinner than half of the smallest size, by which elements in them are not flat.
struct thin_wall_sizes {
  double factor = 1; ///< times twice the thickness
  double least = 0;  ///< where it would be smaller, the wall is given up: it gets the smallest size
};

/// The sizes that curvature and proximity ask for, at points of a model; thin walls are those between two
/// faces without a common curve, and sizes in them not below `least_in_walls`. Of a field from them can be
/// said how far it is to follow thin walls: what that costs in elements is known only when there is one.
class automatic_points {
public:
  /// Throws `sizing_error` for options out of range.
  /// Complexity: that of `curvature_size` and `proximity_size`.
  /// \param model the model whose faces are sampled
  /// \param options elements per circle and per gap, and the range of sizes
  /// \param loop carries out the loops over samples (`sizing::undivided_loop`)
  template <geometry_model G, class Loop = sizing::undivided_loop>
  automatic_points(const G& model, const automatic_options& options, const Loop& loop = {})
      : bounds_(model.bounds()), range_(sizing::range_for(bounds_, options.range)) {
    if (options.elements_per_circle != 0)
      points_ = sizing::curvature_points(model, options.elements_per_circle, range_);
    if (options.elements_across != 0) {
      add(sizing::proximity_points(model,
                                   {.elements = options.elements_across,
                                    .least_in_walls = options.least_in_walls,
                                    .inside = options.inside,
                                    .outside = options.outside},
                                   range_, loop));
    }
  }

  bool has_thin_walls() const { return !walls_.empty(); } ///< that were to be followed
  /// About how many tetrahedra sizes in thin walls make beyond those of the smallest size of the range.
  double elements_in_walls(const thin_wall_sizes& walls = {}) const;
  /// Sizes that add about so many at most: at first all are enlarged, up to where walls are a third of a
  /// size thick and few elements in them are under 12 degrees; then the thinnest walls are given up, which
  /// cost most. About n log n in the points of walls.
  thin_wall_sizes walls_within(double elements) const;

  /// The field of limited growth, precomputed in the model's box. Linear in the cells of the table.
  tabulated_size field(const thin_wall_sizes& walls = {}) const;

private:
  void add(const std::vector<sizing::gap_point>& gaps);
  /// What one point of a wall counts in `elements_in_walls` at a size.
  double elements_at(const sizing::gap_point& wall, double size) const;

  box3 bounds_;
  model_size_range range_;
  std::vector<sized_point> points_;      ///< all, those of thin walls too
  std::vector<sizing::gap_point> walls_; ///< thin ones
};

/// The smallest of what curvature and proximity ask for, as one field of limited growth, precomputed in the
/// model's box. Throws `sizing_error` for options out of range.
/// Complexity: that of `curvature_size` and `proximity_size`, and linear in the cells of the table.
/// \param model the model whose faces are sampled
/// \param options elements per circle and per gap, and the range of sizes
template <geometry_model G>
tabulated_size automatic_size(const G& model, const automatic_options& options = {}) {
  return automatic_points(model, options).field();
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/automatic.ipp"
#endif
