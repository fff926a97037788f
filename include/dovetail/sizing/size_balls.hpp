/// @file
/// The size field of a surface: a given field, bounded by curvature and by refinement balls, with limited
/// growth away from both.
#pragma once

#include "dovetail/core/median_tree.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/sizing/erased.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail {

/// A place where the size must not exceed `size` within `radius` of the center.
struct size_ball {
  vec3 center;
  double radius = 0;
  double size = 0;
};

/// p -> min over balls of size + growth * distance to the ball. A tree over the balls: a query visits few.
class graded_balls {
public:
  graded_balls(std::vector<size_ball> balls, double growth)
      : balls_(std::move(balls)), nodes_(build_median_tree<node>(balls_, leaf_size, center_of)),
        growth_(growth) {}

  std::size_t size() const { return balls_.size(); }

  /// The smaller of `bound` and the field at p.
  double operator()(vec3 p, double bound) const { return nodes_.empty() ? bound : visit(0, p, bound); }

private:
  struct node : median_node {
    double size = std::numeric_limits<double>::infinity(); ///< smallest below
    double radius = 0;                                     ///< largest below

    void include(const size_ball& ball) {
      size = std::min(size, ball.size);
      radius = std::max(radius, ball.radius);
    }
  };
  static constexpr std::size_t leaf_size = 8;

  static constexpr auto center_of = [](const size_ball& ball) { return ball.center; };

  double lower_bound(const node& n, vec3 p) const {
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
      const double out = std::max({n.box.lower[k] - p[k], 0.0, p[k] - n.box.upper[k]});
      squared += out * out;
    }
    return n.size + growth_ * std::max(0.0, std::sqrt(squared) - n.radius);
  }

  double visit(std::size_t id, vec3 p, double bound) const {
    const node& n = nodes_[id];
    if (lower_bound(n, p) >= bound)
      return bound;
    if (n.is_leaf()) {
      for (std::size_t i = n.first; i < n.last; ++i) {
        const size_ball& ball = balls_[i];
        bound = std::min(bound, ball.size + growth_ * std::max(0.0, distance(p, ball.center) - ball.radius));
      }
      return bound;
    }
    std::size_t near = id + 1, far = n.right;
    if (lower_bound(nodes_[far], p) < lower_bound(nodes_[near], p))
      std::swap(near, far);
    return visit(far, p, visit(near, p, bound));
  }

  std::vector<size_ball> balls_;
  std::vector<node> nodes_;
  double growth_;
};

/// A field that is nowhere larger than its bounds allow. Models `bounded_below_sizing_field`.
class bounded_size {
public:
  bounded_size(any_sizing field, std::vector<size_ball> bounds, double growth)
      : field_(std::move(field)), bounds_(std::move(bounds), growth), growth_(growth) {}

  double operator()(vec3 p) const { return bounds_(p, field_(p)); }
  double feature_size(vec3 p) const { return dovetail::feature_size(field_, p); }
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
inline any_sizing within_bounds(any_sizing field, std::vector<size_ball> bounds, double growth) {
  bounds.erase(std::remove_if(bounds.begin(), bounds.end(),
                              [&](const size_ball& ball) { return !(ball.size < field(ball.center)); }),
               bounds.end());
  if (bounds.empty())
    return field;
  return keep_bounds(bounded_size(std::move(field), std::move(bounds), growth));
}

} // namespace dovetail
