/// @file
/// Triangles of a plane, and which of them is at a point.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace dovetail {

/// Triangles that cover a part of a plane once, counter-clockwise. Queries are const, thread-safe, O(log n).
class plane_triangles {
public:
  /// None.
  plane_triangles() = default;
  /// \param triangles by their corners; one is there at least
  explicit plane_triangles(std::vector<std::array<vec2, 3>> triangles) : triangles_(std::move(triangles)) {
    std::vector<box3> boxes;
    for (const auto& corners : triangles_) {
      box3& box = boxes.emplace_back();
      for (const vec2& corner : corners)
        box.include({corner.x, corner.y, 0});
    }
    tree_ = box_tree(boxes);
  }

  /// The corners of a triangle.
  const std::array<vec2, 3>& operator[](std::size_t i) const { return triangles_[i]; }
  /// A box around all of them, at height 0.
  box3 bounds() const { return tree_.bounds(); }

  /// The triangle over which a point lies, or the nearest one.
  std::size_t locate(vec2 uv) const {
    const vec3 p{uv.x, uv.y, 0};
    double deepest = -1e-9;
    local_id found = no_id;
    tree_.for_each([&](const box3& box, std::size_t) { return contains(box, p); },
                   [&](local_id id) {
                     const double d = depth(triangles_[id], uv);
                     if (d > deepest || (d == deepest && id < found)) {
                       deepest = d;
                       found = id;
                     }
                   });
    return static_cast<std::size_t>(found != no_id ? found : nearest(p));
  }

  /// Barycentric coordinates of the point of a triangle nearest a point.
  std::array<double, 3> nearest_weights(std::size_t triangle, vec2 uv) const {
    return nearest_weights(triangles_[triangle], {uv.x, uv.y, 0});
  }

private:
  static double twice_area(vec2 a, vec2 b, vec2 c) { return cross(b - a, c - a); }

  /// Smallest barycentric coordinate: not negative inside.
  static double depth(const std::array<vec2, 3>& t, vec2 p) {
    const double area = twice_area(t[0], t[1], t[2]);
    if (!(area > 0))
      return -std::numeric_limits<double>::infinity();
    return std::min({twice_area(p, t[1], t[2]), twice_area(t[0], p, t[2]), twice_area(t[0], t[1], p)}) / area;
  }

  static std::array<double, 3> nearest_weights(const std::array<vec2, 3>& t, vec3 p) {
    const auto level = [](vec2 q) { return vec3{q.x, q.y, 0}; };
    return nearest_on_triangle(level(t[0]), level(t[1]), level(t[2]), p);
  }

  local_id nearest(vec3 p) const {
    double best = std::numeric_limits<double>::infinity();
    local_id found = 0;
    tree_.for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best; },
        [&](local_id id) {
          const auto& t = triangles_[id];
          const auto w = nearest_weights(t, p);
          const vec2 at = w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
          const double away = norm_squared(vec3{at.x, at.y, 0} - p);
          if (away < best || (away == best && id < found)) {
            best = away;
            found = id;
          }
        });
    return found;
  }

  std::vector<std::array<vec2, 3>> triangles_;
  box_tree tree_;
};

} // namespace dovetail
