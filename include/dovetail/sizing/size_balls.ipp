/// @file
/// What `size_balls.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE graded_balls::graded_balls(std::vector<size_ball> balls, double growth)
    : balls_(std::move(balls)),
      tree_(boxes_of_points(balls_, [](const size_ball& ball) { return ball.center; }), leaf_size),
      growth_(growth) {
  tree_.put_in_order(balls_);
  nodes_ = tree_.reduce<node>([this](local_id k) { return of_ball(k); },
                              [](const node& a, const node& b) {
                                return node{std::min(a.size, b.size), std::max(a.radius, b.radius)};
                              });
}

DOVETAIL_INLINE double graded_balls::operator()(vec3 p, double bound) const {
  const auto lower_bound = [&](std::size_t id) {
    const double gap = std::sqrt(distance_squared(tree_.box(id), p));
    return nodes_[id].size + growth_ * std::max(0.0, gap - nodes_[id].radius);
  };
  return tree_.least(bound, lower_bound, [&](local_id k) {
    const size_ball& ball = balls_[k];
    return ball.size + growth_ * std::max(0.0, distance(p, ball.center) - ball.radius);
  });
}

DOVETAIL_INLINE any_sizing within_bounds(any_sizing field, std::vector<size_ball> bounds, double growth) {
  bounds.erase(std::remove_if(bounds.begin(), bounds.end(),
                              [&](const size_ball& ball) { return !(ball.size < field(ball.center)); }),
               bounds.end());
  if (bounds.empty())
    return field;
  return keep_bounds(bounded_size(std::move(field), std::move(bounds), growth));
}

} // namespace dovetail
