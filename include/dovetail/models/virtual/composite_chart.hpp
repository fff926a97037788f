/// @file
/// Several surfaces that go on smoothly into each other as one, over a plane.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/geometry/frame.hpp"
#include "dovetail/models/plane_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail::virtual_topology {

/// A triangle between points of a face's surface.
struct charted_triangle {
  local_id face = no_id;       ///< of the model
  std::array<vec2, 3> own{};   ///< parameters of its corners on that face
  std::array<vec3, 3> space{}; ///< its corners
};

/// The surfaces of some faces as heights over one plane, whose coordinates are the parameters: each point is
/// exactly on a surface of the model. Which one, and about where, is found by triangles, which are told to
/// cover a part of the plane once; the rest by Newton's method. Beyond the triangles the surface of the
/// nearest one goes on, and where that ends, or turns away, its tangent plane. Queries are const, and
/// thread-safe as the model's; O(log n), and a few of the model.
class composite_chart {
public:
  /// \param frame parameters are along its u and v
  /// \param triangles counter-clockwise as seen against its n
  composite_chart(const discrete::chart_frame& frame, std::vector<charted_triangle> triangles)
      : frame_(frame), triangles_(std::move(triangles)) {
    std::vector<std::array<vec2, 3>> flat;
    std::vector<box3> solid;
    for (const charted_triangle& t : triangles_) {
      box3& box = solid.emplace_back();
      auto& corners = flat.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = frame_.flat(t.space[i]);
        box.include(t.space[i]);
        height_ = std::max(height_, std::abs(dot(t.space[i] - frame_.origin, frame_.n)));
      }
    }
    flat_ = plane_triangles(std::move(flat));
    in_space_ = box_tree(solid);
    rounding_ = 1e-13 * in_space_.bounds().diagonal();
  }

  /// The plane that all surfaces are in, if they are in one.
  std::optional<surface_frame> plane() const {
    constexpr double flat = 1e-9; // of the diagonal
    if (height_ > flat * in_space_.bounds().diagonal())
      return std::nullopt;
    return surface_frame{frame_.origin, frame_.u, frame_.v};
  }

  /// The parameters of the point below another one.
  vec2 flat(vec3 p) const { return frame_.flat(p); }

  /// The point and its derivatives.
  surface_frame frame(const any_geometry& model, vec2 uv) const {
    if (plane())
      return {frame_.origin + uv.x * frame_.u + uv.y * frame_.v, frame_.u, frame_.v};
    const std::size_t t = flat_.locate(uv);
    if (const auto found = solved(model, t, uv))
      return over_plane(found->frame);
    const vec2 inside = foot(t, uv);
    const auto beside = solved(model, t, inside);
    surface_frame made = beside ? over_plane(beside->frame) : over_triangle(t, inside);
    made.point += (uv.x - inside.x) * made.du + (uv.y - inside.y) * made.dv;
    return made;
  }

  /// The point.
  vec3 point(const any_geometry& model, vec2 uv) const { return frame(model, uv).point; }

  /// The largest absolute principal curvature.
  double curvature(const any_geometry& model, vec2 uv) const {
    if (plane())
      return 0;
    const std::size_t t = flat_.locate(uv);
    const auto found = solved(model, t, uv);
    return model.face_curvature(triangles_[t].face, found ? found->own : own_at(t, uv));
  }

  /// Parameters of the nearest point of the surfaces: of the one whose triangle is nearest, or of the one
  /// that is over what is found so.
  vec2 project(const any_geometry& model, vec3 p) const {
    const vec2 below = flat(p);
    if (plane() || distance(point(model, below), p) <= 10 * rounding_)
      return below;
    const auto [nearest, seen] = nearest_in_space(p);
    vec2 best = flat(seen);
    try {
      return projected(model, p, nearest, best);
    } catch (const geometry_error&) { // of a place where the kernel cannot evaluate a face
      return best;
    }
  }

  /// The face whose surface is nearest, by the triangles.
  local_id face_at(vec3 p) const { return triangles_[nearest_in_space(p).first].face; }

private:
  static constexpr std::size_t most_faces_tried = 3;
  static constexpr double steepest =
      0.05; ///< cosine to the plane below which a surface has no height over it

  /// The same, begun at a triangle. `best` becomes the nearest of what was found.
  vec2 projected(const any_geometry& model, vec3 p, std::size_t t, vec2& best) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t tries = 0; tries < most_faces_tried; ++tries) {
      const local_id face = triangles_[t].face;
      const vec2 own = model.project_to_face(face, p, own_at(t, best));
      const vec3 q = model.face_point(face, own);
      const vec2 at = flat(q);
      const std::size_t over = flat_.locate(at);
      if (triangles_[over].face == face)
        return at;
      if (const double away = distance(q, p); away < least) {
        least = away;
        best = at;
      }
      t = over;
    }
    return best; // between two surfaces
  }

  struct place {
    vec2 own; ///< parameters on the face of the triangle
    surface_frame frame;
  };

  /// Where the surface of a triangle's face is over a point of the plane, if it is found near the triangle.
  std::optional<place> solved(const any_geometry& model, std::size_t t, vec2 uv) const {
    try {
      return solved_by_newton(model, t, uv);
    } catch (const geometry_error&) { // of a place where the kernel cannot evaluate the face
      return std::nullopt;
    }
  }
  std::optional<place> solved_by_newton(const any_geometry& model, std::size_t t, vec2 uv) const {
    constexpr int most_steps = 12;
    constexpr double largest_step = 3;  // triangles
    constexpr double near_enough = 1e3; // roundings
    const charted_triangle& triangle = triangles_[t];
    vec2 own = own_at(t, uv);
    double before = largest_step * length_of(t);
    for (int step = 0; step < most_steps; ++step) {
      const surface_frame frame = model.face_frame(triangle.face, own);
      const vec2 off = uv - flat(frame.point);
      const double away = norm(off);
      if (is_steep(frame) || !(away <= before))
        return std::nullopt;
      const vec2 du{dot(frame.du, frame_.u), dot(frame.du, frame_.v)};
      const vec2 dv{dot(frame.dv, frame_.u), dot(frame.dv, frame_.v)};
      const double area = cross(du, dv);
      const vec2 next = own + vec2{cross(off, dv) / area, cross(du, off) / area};
      if (away <= rounding_ || next == own)
        return place{own, frame};
      own = next;
      before = std::max(away, near_enough * rounding_);
    }
    const surface_frame frame = model.face_frame(triangle.face, own);
    if (is_steep(frame) || !(norm(uv - flat(frame.point)) <= near_enough * rounding_))
      return std::nullopt;
    return place{own, frame};
  }

  /// Parameters on its face at the point of a triangle nearest a point of the plane.
  vec2 own_at(std::size_t t, vec2 uv) const {
    const auto w = flat_.nearest_weights(t, uv);
    const auto& own = triangles_[t].own;
    return w[0] * own[0] + w[1] * own[1] + w[2] * own[2];
  }
  vec2 foot(std::size_t t, vec2 uv) const {
    const auto w = flat_.nearest_weights(t, uv);
    return w[0] * flat_[t][0] + w[1] * flat_[t][1] + w[2] * flat_[t][2];
  }

  double length_of(std::size_t t) const {
    const auto& corners = flat_[t];
    return std::max(
        {norm(corners[1] - corners[0]), norm(corners[2] - corners[1]), norm(corners[0] - corners[2])});
  }

  bool is_steep(vec3 normal) const { return !(std::abs(dot(normal, frame_.n)) > steepest * norm(normal)); }
  bool is_steep(const surface_frame& frame) const { return is_steep(cross(frame.du, frame.dv)); }

  /// The point of a surface, which is not steep, with derivatives by the plane's coordinates.
  surface_frame over_plane(const surface_frame& own) const {
    return with_normal(own.point, cross(own.du, own.dv));
  }
  /// The same of a triangle; one that stands on edge is taken as level.
  surface_frame over_triangle(std::size_t t, vec2 uv) const {
    const auto w = flat_.nearest_weights(t, uv);
    const auto& [a, b, c] = triangles_[t].space;
    const vec3 p = w[0] * a + w[1] * b + w[2] * c, normal = cross(b - a, c - a);
    return is_steep(normal) ? surface_frame{p, frame_.u, frame_.v} : with_normal(p, normal);
  }
  surface_frame with_normal(vec3 p, vec3 normal) const {
    const double up = dot(normal, frame_.n);
    return {p, frame_.u - (dot(normal, frame_.u) / up) * frame_.n,
            frame_.v - (dot(normal, frame_.v) / up) * frame_.n};
  }

  /// A triangle and its point there.
  std::pair<std::size_t, vec3> nearest_in_space(vec3 p) const {
    double best = std::numeric_limits<double>::infinity();
    std::pair<std::size_t, vec3> nearest;
    in_space_.for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best; },
        [&](local_id id) {
          const auto index = static_cast<std::size_t>(id);
          const auto& [a, b, c] = triangles_[index].space;
          const auto w = nearest_on_triangle(a, b, c, p);
          const vec3 foot = w[0] * a + w[1] * b + w[2] * c;
          const double away = norm_squared(foot - p);
          if (away < best || (away == best && index < nearest.first)) {
            best = away;
            nearest = {index, foot};
          }
        });
    return nearest;
  }

  discrete::chart_frame frame_;
  std::vector<charted_triangle> triangles_;
  plane_triangles flat_; ///< the same in the plane
  box_tree in_space_;
  double height_ = 0;   ///< of all corners over the plane
  double rounding_ = 0; ///< distances below this are none
};

} // namespace dovetail::virtual_topology
