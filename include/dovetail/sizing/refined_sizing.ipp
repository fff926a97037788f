/// @file
/// What `refined_sizing.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/sizing/refined_sizing.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE void refined_sizing::refine(std::span<const size_ball> more) {
  for (const size_ball& ball : more)
    if (const double plain = plain_(ball.center); ball.size < plain) {
      balls_.push_back(ball);
      reaches_.push_back(ball.radius + (plain - ball.size) / growth);
    }
  std::vector<box3> boxes;
  for (std::size_t k = 0; k < balls_.size(); ++k)
    boxes.push_back(inflated({balls_[k].center, balls_[k].center}, reaches_[k]));
  tree_ = box_tree(boxes);
}

DOVETAIL_INLINE std::vector<size_ball> refined_sizing::balls_near(const box3& entity) const {
  std::vector<std::size_t> found;
  tree_.for_each([&](const box3& node, std::size_t) { return node.overlaps(entity); },
                 [&](local_id ball) {
                   const auto k = static_cast<std::size_t>(ball);
                   if (distance_squared(entity, balls_[k].center) <= reaches_[k] * reaches_[k])
                     found.push_back(k);
                 });
  std::sort(found.begin(), found.end());
  std::vector<size_ball> balls;
  for (const std::size_t k : found)
    balls.push_back(balls_[k]);
  return balls;
}

DOVETAIL_INLINE box3 box_around(std::span<const vec3> points) {
  box3 box;
  for (const vec3 p : points)
    box.include(p);
  return box;
}

} // namespace dovetail
