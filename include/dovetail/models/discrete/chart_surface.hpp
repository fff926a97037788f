/// @file
/// One chart as a surface over its plane.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// The graph of a piecewise linear height over a plane. Beyond the triangles the surface goes on in the plane
/// of the nearest one. Queries are const, thread-safe, O(log n).
class chart_surface {
public:
  /// `curvatures`: per triangle, the largest absolute principal curvature estimated for it.
  chart_surface(const chart_frame& frame, std::vector<std::array<vec3, 3>> triangles,
                std::vector<double> curvatures)
      : frame_(frame), curvatures_(std::move(curvatures)) {
    std::vector<box3> flat;
    std::vector<box3> solid;
    for (const auto& corners : triangles) {
      triangle t;
      t.space = corners;
      box3 flat_box;
      box3 box;
      for (std::size_t i = 0; i < 3; ++i) {
        t.flat[i] = frame.flat(corners[i]);
        flat_box.include({t.flat[i].x, t.flat[i].y, 0});
        box.include(corners[i]);
      }
      set_slopes(t);
      flat.push_back(flat_box);
      solid.push_back(box);
      triangles_.push_back(t);
    }
    flat_tree_ = box_tree(flat);
    space_tree_ = box_tree(solid);
    on_surface_ = 1e-12 * space_tree_.bounds().diagonal();
  }

  /// The point of the surface over a point of the plane.
  vec3 point(vec2 uv) const { return lifted(triangles_[locate(uv)], uv); }

  /// The point and its derivatives.
  surface_frame frame(vec2 uv) const {
    const triangle& t = triangles_[locate(uv)];
    return {lifted(t, uv), frame_.u + t.slope.x * frame_.n, frame_.v + t.slope.y * frame_.n};
  }

  /// The largest curvature, as estimated for the triangle there.
  double curvature(vec2 uv) const { return curvatures_[locate(uv)]; }

  /// Parameters of the point of the surface nearest p: of the chart, or of its continuation beyond the
  /// nearest triangle. A point of the surface, extended or not, gives its own parameters.
  vec2 project(vec3 p) const {
    const vec2 below = frame_.flat(p);
    if (distance(point(below), p) <= on_surface_)
      return below;
    const auto [nearest, foot] = nearest_in_space(p);
    const triangle& t = triangles_[nearest];
    const vec3 n = normalized(cross(t.space[1] - t.space[0], t.space[2] - t.space[0]));
    const vec2 on_plane = frame_.flat(p - dot(p - t.space[0], n) * n);
    return dot(n, frame_.n) > steepest && locate(on_plane) == nearest ? on_plane : foot;
  }

private:
  struct triangle {
    std::array<vec3, 3> space;
    std::array<vec2, 3> flat;
    vec2 slope; ///< of the height along u and v
  };

  /// The plane of the triangle as a height over (u, v); a triangle on edge is taken as level.
  void set_slopes(triangle& t) const {
    const vec3 n = cross(t.space[1] - t.space[0], t.space[2] - t.space[0]);
    const double up = dot(n, frame_.n);
    if (up > steepest * norm(n))
      t.slope = {-dot(n, frame_.u) / up, -dot(n, frame_.v) / up};
  }

  vec3 lifted(const triangle& t, vec2 uv) const {
    const vec2 d = uv - t.flat[0];
    const double height = dot(t.space[0] - frame_.origin, frame_.n) + dot(t.slope, d);
    return frame_.origin + uv.x * frame_.u + uv.y * frame_.v + height * frame_.n;
  }

  std::pair<std::size_t, vec2> nearest_in_space(vec3 p) const {
    double best = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    vec2 uv;
    space_tree_.for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best; },
        [&](local_id id) {
          const auto index = static_cast<std::size_t>(id);
          const triangle& t = triangles_[index];
          const auto w = nearest_on_triangle(t.space[0], t.space[1], t.space[2], p);
          const double away = norm_squared(w[0] * t.space[0] + w[1] * t.space[1] + w[2] * t.space[2] - p);
          if (away < best || (away == best && index < nearest)) {
            best = away;
            nearest = index;
            uv = w[0] * t.flat[0] + w[1] * t.flat[1] + w[2] * t.flat[2];
          }
        });
    return {nearest, uv};
  }

  static double twice_area(vec2 a, vec2 b, vec2 c) { return cross(b - a, c - a); }

  /// Smallest barycentric coordinate: not negative inside.
  static double depth(const triangle& t, vec2 p) {
    const double area = twice_area(t.flat[0], t.flat[1], t.flat[2]);
    if (!(area > 0))
      return -std::numeric_limits<double>::infinity();
    return std::min({twice_area(p, t.flat[1], t.flat[2]), twice_area(t.flat[0], p, t.flat[2]),
                     twice_area(t.flat[0], t.flat[1], p)}) /
           area;
  }

  /// The triangle over which uv lies, or the nearest one.
  std::size_t locate(vec2 uv) const {
    const vec3 p{uv.x, uv.y, 0};
    double deepest = -1e-9;
    local_id found = no_id;
    flat_tree_.for_each([&](const box3& box, std::size_t) { return contains(box, p); },
                        [&](local_id id) {
                          const double d = depth(triangles_[id], uv);
                          if (d > deepest || (d == deepest && id < found)) {
                            deepest = d;
                            found = id;
                          }
                        });
    return static_cast<std::size_t>(found != no_id ? found : nearest(p));
  }

  local_id nearest(vec3 p) const {
    double best = std::numeric_limits<double>::infinity();
    local_id found = 0;
    flat_tree_.for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best; },
        [&](local_id id) {
          const triangle& t = triangles_[id];
          const auto level = [](vec2 q) { return vec3{q.x, q.y, 0}; };
          const auto w = nearest_on_triangle(level(t.flat[0]), level(t.flat[1]), level(t.flat[2]), p);
          const vec2 foot = w[0] * t.flat[0] + w[1] * t.flat[1] + w[2] * t.flat[2];
          const double away = norm_squared(level(foot) - p);
          if (away < best || (away == best && id < found)) {
            best = away;
            found = id;
          }
        });
    return found;
  }

  static constexpr double steepest = 1e-3; ///< cosine below which a triangle stands on edge

  chart_frame frame_;
  double on_surface_ = 0; ///< distances below this are rounding
  std::vector<triangle> triangles_;
  std::vector<double> curvatures_;
  box_tree flat_tree_;
  box_tree space_tree_;
};

} // namespace dovetail::discrete
