/// @file
/// The size field of a surface: a given field, bounded by curvature and by refinement balls, with limited
/// growth away from both.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/sizing/erased.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

/// A place where the size must not exceed `size` within `radius` of the center.
struct size_ball {
  vec3 center; ///< where the ball is
  double radius = 0;
  double size = 0;
};

/// p -> min over balls of size + growth * distance to the ball. A tree over the balls: a query visits few.
class graded_balls {
public:
  graded_balls(std::vector<size_ball> balls, double growth);

  std::size_t size() const { return balls_.size(); }

  /// The smaller of `bound` and the field at p.
  double operator()(vec3 p, double bound) const;

private:
  struct node {
    double size = 0;   ///< smallest below
    double radius = 0; ///< largest below
  };
  static constexpr std::size_t leaf_size = 8;

  node of_ball(local_id k) const {
    const size_ball& ball = balls_[k];
    return {ball.size, ball.radius};
  }

  std::vector<size_ball> balls_;
  box_tree tree_;
  std::vector<node> nodes_;
  double growth_;
};

/// A field that is nowhere larger than its bounds allow. Models `bounded_below_sizing_field`.
class bounded_size {
public:
  bounded_size(any_sizing field, std::vector<size_ball> bounds, double growth)
      : field_(std::move(field)), bounds_(std::move(bounds), growth), growth_(growth) {}

  double operator()(vec3 p) const { return bounds_(p, field_(p)); }               ///< the size at a point
  double feature_size(vec3 p) const { return dovetail::feature_size(field_, p); } ///< that of the given field
  /// A lower bound over a box.
  double smallest_size_in(const box3& box) const {
    const double of_field = dovetail::smallest_size_in(field_, box);
    const double least = bounds_(box.center(), 1e300) - 0.5 * growth_ * box.diagonal();
    return std::max(0.0, std::min(of_field, least));
  }

private:
  any_sizing field_;
  graded_balls bounds_;
  double growth_;
};

/// `field`, held within those of the bounds that ask for less than it does at their centers.
any_sizing within_bounds(any_sizing field, std::vector<size_ball> bounds, double growth);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/size_balls.ipp"
#endif
