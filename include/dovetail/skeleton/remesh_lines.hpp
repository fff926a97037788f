/// @file
/// Points on skeleton lines, spaced by the sizing field: on the CAD curve, projected to the CAD face, or
/// straight (paper, section 3.5). A line's points are a function of the line, the model and the field
/// alone.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/parallel/memo.hpp"
#include "dovetail/parallel/task_model.hpp"
#include "dovetail/remesh/line_spacing.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/refined_sizing.hpp"
#include "dovetail/skeleton/fine_lines.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The chord between two points of a CAD face, projected to it; where the projection strays, the straight
/// line in the parameter plane instead.
template <geometry_model Geometry>
class face_line {
public:
  face_line(const Geometry& model, const skeleton_line& line, vec3 first, vec3 last)
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
  const Geometry& model_;
  local_id face_;
  std::array<vec2, 2> uv_;
  vec3 first_, chord_;
  bool projected_ = true;
};

template <geometry_model Geometry, sizing_field Size>
fine_line space_on_curve(const Geometry& model, const skeleton_line& line, const Size& size) {
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

template <geometry_model Geometry, sizing_field Size>
fine_line space_on_face(const Geometry& model, const skeleton_line& line, vec3 first, vec3 last,
                        const Size& size) {
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

template <sizing_field Size>
fine_line space_straight(const skeleton_line& line, vec3 first, vec3 last, const Size& size) {
  const auto straight = [&](double s) { return curve_frame{first + s * (last - first), last - first}; };
  const auto s = remesh::line_spacing{
      .even_when_few = true, .given_segments = line.segments, .bias = line.bias}(straight, 0.0, 1.0, size);
  fine_line fine;
  for (std::size_t i = 1; i + 1 < s.size(); ++i)
    fine.points.push_back(straight(s[i]).point);
  return fine;
}

} // namespace detail

/// Points of one line. `coarse_points` are the points of the background mesh.
/// About linear in the points made. Throws what the model and the field throw.
/// \param model the model that the line is of
/// \param line of the coarse skeleton
/// \param coarse_points those that the line refers to
/// \param size edge lengths wanted, in the units of the model
template <geometry_model Geometry, sizing_field Size>
fine_line remesh_line(const Geometry& model, const skeleton_line& line, std::span<const vec3> coarse_points,
                      const Size& size) {
  const vec3 first = coarse_points[line.vertices[0]];
  const vec3 last = coarse_points[line.vertices[1]];
  if (line.on.dimension == 1)
    return detail::space_on_curve(model, line, size);
  if (line.on.dimension == 2)
    return detail::space_on_face(model, line, first, last, size);
  return detail::space_straight(line, first, last, size);
}

/// The box in which a line looks for refined sizes.
box3 place_of(const skeleton_line& line, std::span<const vec3> coarse_points);

/// The points of a line, which are a function of it, its ends and what refines the sizes near it.
kept<fine_line> kept_line(const skeleton_line& line, std::span<const vec3> coarse_points,
                          const refined_sizing& size);

/// Points of all lines; those that are not in `made` are made through `run`, and those that have not changed
/// since `before` are moved from there.
/// Throws `mesher_error` naming what could not be evaluated.
/// About linear in the points made.
/// \param model the model that the lines are of
/// \param lines lines of the coarse skeleton
/// \param coarse_points points of the background mesh, that lines refer to
/// \param size edge lengths wanted, in the units of the model
/// \param run carries out independent tasks; the result does not depend on it
/// \param made lines of earlier rounds; grows
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
/// \param before what was made of lines of the same numbers, such as these with other segments; or nothing
template <geometry_model Geometry, executor Executor>
remeshed_lines remesh_lines(const Geometry& model, std::span<const skeleton_line> lines,
                            std::span<const vec3> coarse_points, const refined_sizing& size,
                            const Executor& run, memo<fine_line>& made, const progress& on_progress = {},
                            remeshed_lines before = {}) {
  constexpr double lines_per_task = 256;
  remeshed_lines result;
  std::vector<kept<fine_line>>& wanted = result.names;
  wanted.reserve(lines.size());
  for (const skeleton_line& line : lines)
    wanted.push_back(kept_line(line, coarse_points, size));
  const std::vector<double> costs(lines.size(), 1);
  const auto failures = made.make_missing(
      wanted, costs, lines_per_task,
      [&](const std::vector<std::size_t>& missing) {
        const task_model own(model, run);
        std::vector<fine_line> fine;
        for (const std::size_t l : missing)
          fine.push_back(
              remesh_line(own.get(), lines[l], coarse_points, size.near(place_of(lines[l], coarse_points))));
        return fine;
      },
      run, run_options{.on_progress = on_progress, .stage = "lines"});
  if (!failures.empty())
    throw mesher_error("remeshing of skeleton lines failed: " + failures.front().reason);
  result.lines.resize(lines.size());
  std::vector<std::size_t> others; // that are read
  std::vector<kept<fine_line>> names;
  for (std::size_t l = 0; l < lines.size(); ++l)
    if (l < before.names.size() && before.names[l] == wanted[l]) {
      result.lines[l] = std::move(before.lines[l]);
    } else {
      others.push_back(l);
      names.push_back(wanted[l]);
    }
  made.for_each(names, [&](std::size_t i, const fine_line& line) { result.lines[others[i]] = line; });
  return result;
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/remesh_lines.ipp"
#endif
