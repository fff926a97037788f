/// @file
/// What `remesh_lines.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/task_model.hpp"
#include "dovetail/remesh/line_spacing.hpp"
#include "dovetail/skeleton/remesh_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

namespace detail {

/// The chord between two points of a CAD face, projected to it; where the projection strays, the straight
/// line in the parameter plane instead.
class face_line {
public:
  face_line(const any_geometry& model, const skeleton_line& line, vec3 first, vec3 last)
      : model_(model), face_(line.on.id), uv_(line.uv), first_(first), chord_(last - first) {
    constexpr int probes = 8;
    double before = 0;
    for (int i = 1; i < probes && projected_; ++i) {
      const double s = static_cast<double>(i) / probes;
      const vec3 p = model_.face_point(face_, uv(s));
      const double along = dot(p - first_, chord_) / norm_squared(chord_);
      projected_ = distance(p, first_ + s * chord_) < 0.35 * norm(chord_) && along > before && along < 1;
      before = along;
    }
  }

  vec2 uv(double s) const {
    const vec2 straight = (1 - s) * uv_[0] + s * uv_[1];
    if (!projected_ || s <= 0 || s >= 1)
      return straight;
    return model_.project_to_face(face_, first_ + s * chord_, straight);
  }

  curve_frame operator()(double s) const {
    const surface_frame at = model_.face_frame(face_, uv(s));
    if (!projected_) {
      const vec2 d = uv_[1] - uv_[0];
      return {at.point, d.x * at.du + d.y * at.dv};
    }
    const vec3 normal = normalized(cross(at.du, at.dv));
    return {at.point, chord_ - dot(chord_, normal) * normal};
  }

private:
  const any_geometry& model_;
  local_id face_;
  std::array<vec2, 2> uv_;
  vec3 first_, chord_;
  bool projected_ = true;
};

inline fine_line space_on_curve(const any_geometry& model, const skeleton_line& line,
                                const any_sizing& size) {
  const auto curve = [&](double t) { return model.curve_frame(line.on.id, t); };
  const bool backwards = line.t[0] > line.t[1];
  auto t = remesh::line_spacing{.given_segments = line.segments, .bias = backwards ? -line.bias : line.bias}(
      curve, std::min(line.t[0], line.t[1]), std::max(line.t[0], line.t[1]), size);
  if (backwards)
    std::reverse(t.begin(), t.end());
  fine_line fine;
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    fine.t.push_back(t[i]);
    fine.points.push_back(model.curve_point(line.on.id, t[i]));
  }
  return fine;
}

inline fine_line space_on_face(const any_geometry& model, const skeleton_line& line, vec3 first, vec3 last,
                               const any_sizing& size) {
  const face_line on_face(model, line, first, last);
  const auto s = remesh::line_spacing{
      .even_when_few = true, .given_segments = line.segments, .bias = line.bias}(on_face, 0.0, 1.0, size);
  fine_line fine;
  for (std::size_t i = 1; i + 1 < s.size(); ++i) {
    fine.uv.push_back(on_face.uv(s[i]));
    fine.points.push_back(model.face_point(line.on.id, fine.uv.back()));
  }
  return fine;
}

inline fine_line space_straight(const skeleton_line& line, vec3 first, vec3 last, const any_sizing& size) {
  const auto straight = [&](double s) { return curve_frame{first + s * (last - first), last - first}; };
  const auto s = remesh::line_spacing{
      .even_when_few = true, .given_segments = line.segments, .bias = line.bias}(straight, 0.0, 1.0, size);
  fine_line fine;
  for (std::size_t i = 1; i + 1 < s.size(); ++i)
    fine.points.push_back(straight(s[i]).point);
  return fine;
}

} // namespace detail

DOVETAIL_INLINE fine_line remesh_line(const any_geometry& model, const skeleton_line& line,
                                      std::span<const vec3> coarse_points, const any_sizing& size) {
  const vec3 first = coarse_points[line.vertices[0]];
  const vec3 last = coarse_points[line.vertices[1]];
  if (line.on.dimension == 1)
    return detail::space_on_curve(model, line, size);
  if (line.on.dimension == 2)
    return detail::space_on_face(model, line, first, last, size);
  return detail::space_straight(line, first, last, size);
}

DOVETAIL_INLINE box3 place_of(const skeleton_line& line, std::span<const vec3> coarse_points) {
  const std::array ends{coarse_points[line.vertices[0]], coarse_points[line.vertices[1]]};
  return roomy_box_around(ends);
}

DOVETAIL_INLINE kept<fine_line> kept_line(const skeleton_line& line, std::span<const vec3> coarse_points,
                                          const refined_sizing& size) {
  const std::array ends{coarse_points[line.vertices[0]], coarse_points[line.vertices[1]]};
  return kept<fine_line>::of(line.on, line.t, line.uv, line.segments, line.bias, ends,
                             size.balls_near(place_of(line, coarse_points)));
}

} // namespace dovetail
