/// @file
/// One chart as a surface over its plane.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/frame.hpp"
#include "dovetail/models/plane_triangles.hpp"

#include <array>
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
    std::vector<std::array<vec2, 3>> flat;
    std::vector<box3> solid;
    for (const auto& corners : triangles) {
      triangle t;
      t.space = corners;
      box3 box;
      for (std::size_t i = 0; i < 3; ++i) {
        t.flat[i] = frame.flat(corners[i]);
        box.include(corners[i]);
      }
      set_slopes(t);
      flat.push_back(t.flat);
      solid.push_back(box);
      triangles_.push_back(t);
    }
    flat_ = plane_triangles(std::move(flat));
    space_tree_ = box_tree(solid);
    on_surface_ = 1e-12 * space_tree_.bounds().diagonal();
  }

  /// The point of the surface over a point of the plane.
  vec3 point(vec2 uv) const { return lifted(triangles_[flat_.locate(uv)], uv); }

  /// The point and its derivatives.
  surface_frame frame(vec2 uv) const {
    const triangle& t = triangles_[flat_.locate(uv)];
    return {lifted(t, uv), frame_.u + t.slope.x * frame_.n, frame_.v + t.slope.y * frame_.n};
  }

  /// The largest curvature, as estimated for the triangle there.
  double curvature(vec2 uv) const { return curvatures_[flat_.locate(uv)]; }

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
    return dot(n, frame_.n) > steepest && flat_.locate(on_plane) == nearest ? on_plane : foot;
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

  static constexpr double steepest = 1e-3; ///< cosine below which a triangle stands on edge

  chart_frame frame_;
  double on_surface_ = 0; ///< distances below this are rounding
  std::vector<triangle> triangles_;
  std::vector<double> curvatures_;
  plane_triangles flat_; ///< the same in the plane
  box_tree space_tree_;
};

} // namespace dovetail::discrete
