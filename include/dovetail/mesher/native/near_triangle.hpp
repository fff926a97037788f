/// @file
/// A triangle of a piece's boundary, and what it keeps points away from.
#pragma once

#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace dovetail::detail {

/// A boundary triangle as new points see it.
class near_triangle {
public:
  /// The size is what the field says in the middle; where the triangle is much smaller, its own counts.
  near_triangle(std::array<vec3, 3> corners, const any_sizing& size) {
    // In one order, so that nothing depends on which corner comes first.
    std::sort(corners.begin(), corners.end(),
              [](vec3 a, vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    std::tie(a_, b_, c_) = std::tie(corners[0], corners[1], corners[2]);
    middle_ = (a_ + b_ + c_) / 3.0;
    const double mean_edge = (norm(a_ - b_) + norm(b_ - c_) + norm(c_ - a_)) / 3.0;
    size_ = std::min(checked_size(size, middle_), much_larger * mean_edge);
    radius_ = std::sqrt(
        std::max({norm_squared(a_ - middle_), norm_squared(b_ - middle_), norm_squared(c_ - middle_)}));
    find_ball_and_normal();
    far_ = std::max(size_, cap_height * std::min(radius_, std::sqrt(ball_radius_squared_)));
  }

  double size() const { return size_; }
  vec3 middle() const { return middle_; }
  /// Where points are that the triangle has a say about.
  box3 reach() const {
    box3 box;
    for (const vec3 p : {a_, b_, c_})
      box.include(p);
    return inflated(box, far_);
  }
  /// Enough of the triangle to see of most points that it does not forbid them.
  struct surroundings {
    vec3 middle;
    double radius, far;

    /// As `forbids`, but may be true where that is false.
    bool may_forbid(vec3 p, double clearance) const {
      const double reach = radius + std::max(clearance, far);
      return norm_squared(p - middle) <= reach * reach;
    }
  };
  surroundings around() const { return {middle_, radius_, far_}; }
  /// Is p nearer than `clearance`, or in the smallest ball with the triangle's corners on it and near it?
  bool forbids(vec3 p, double clearance) const {
    const bool in_ball = norm_squared(p - ball_center_) < ball_radius_squared_;
    const double forbidden = in_ball ? std::max(clearance, far_) : clearance;
    const double reach = radius_ + forbidden, height = dot(normal_, p - middle_);
    if (norm_squared(p - middle_) > slack * reach * reach || height * height > slack * forbidden * forbidden)
      return false;
    return distance_squared_to(p) < forbidden * forbidden;
  }

private:
  static constexpr double much_larger = 1.6; ///< sizes over mean edges; in a mesh of one size there is none
  /// Over the radius: how far a ball around a triangle that is large for the sizes still counts. The rest of
  /// the triangle's neighbourhood is outside of the piece, where no points are made.
  static constexpr double cap_height = 0.3;
  static constexpr double slack = 1.001; ///< so that rounding decides in `distance_squared_to` alone
  /// Over the square of the longest edge: of shorter area vectors the direction is not to be relied on.
  static constexpr double least_area = 1e-6;
  double distance_squared_to(vec3 p) const {
    const auto w = nearest_on_triangle(a_, b_, c_, p);
    return norm_squared(w[0] * a_ + w[1] * b_ + w[2] * c_ - p);
  }
  /// A flat triangle has none of both.
  void find_ball_and_normal() {
    const vec3 ab = b_ - a_;
    const vec3 ac = c_ - a_;
    const vec3 normal = cross(ab, ac);
    const double divisor = 2 * norm_squared(normal);
    if (!(divisor > 0))
      return;
    const vec3 to_center =
        (norm_squared(ac) * cross(normal, ab) + norm_squared(ab) * cross(ac, normal)) / divisor;
    ball_center_ = a_ + to_center;
    ball_radius_squared_ = norm_squared(to_center);
    const double longest = std::max({norm_squared(ab), norm_squared(ac), norm_squared(c_ - b_)});
    if (norm(normal) > least_area * longest)
      normal_ = normal / norm(normal);
  }

  vec3 a_, b_, c_;
  vec3 middle_, ball_center_;
  vec3 normal_; ///< of length 1, or 0 for a nearly flat triangle, whose heights say nothing
  double size_ = 0;
  double radius_ = 0; ///< of the ball about the middle that the triangle is in
  double ball_radius_squared_ = 0;
  double far_ = 0; ///< from the triangle: how far the ball counts
};

} // namespace dovetail::detail
