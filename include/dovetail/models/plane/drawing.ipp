/// @file
/// What `drawing.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/models/plane/drawing.hpp"
#include "dovetail/models/plane/segments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

DOVETAIL_INLINE std::string name_of_path(const plane_drawing& drawing, std::size_t path) {
  const bool polygon = path < drawing.polygons.size();
  const std::size_t index = polygon ? path : path - drawing.polygons.size();
  const std::string& name = (polygon ? drawing.polygons : drawing.lines)[index].name;
  return (polygon ? "polygon " : "line ") + std::to_string(index) + (name.empty() ? "" : " '" + name + "'");
}

DOVETAIL_INLINE std::string text_of(vec2 p) {
  return std::string("(").append(number_text(p.x)).append(", ").append(number_text(p.y)).append(")");
}

inline std::vector<drawn_segment> segments_of(const plane_drawing& drawing) {
  std::vector<drawn_segment> segments;
  for (std::size_t path = 0; path < drawing.polygons.size() + drawing.lines.size(); ++path) {
    const bool polygon = path < drawing.polygons.size();
    const auto& points =
        (polygon ? drawing.polygons[path] : drawing.lines[path - drawing.polygons.size()]).points;
    for (std::size_t i = 0; i + (polygon ? 0 : 1) < points.size(); ++i)
      segments.push_back({points[i], points[(i + 1) % points.size()], path, i});
  }
  return segments;
}

DOVETAIL_INLINE double signed_area(const std::vector<vec2>& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += 0.5 * cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return area;
}

inline void require_proper_path(const plane_drawing& drawing, std::size_t path, const plane_path& given,
                                bool closed) {
  const std::string name = name_of_path(drawing, path);
  const auto& points = given.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y))
      throw geometry_error(name + ": point " + std::to_string(i) + " is not a number");
  if (points.size() < (closed ? 3u : 2u))
    throw geometry_error(name + " has " + std::to_string(points.size()) + " points; give at least " +
                         (closed ? "3" : "2"));
  for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i)
    if (const std::size_t j = (i + 1) % points.size(); points[i] == points[j])
      throw geometry_error(name + ": points " + std::to_string(i) + " and " + std::to_string(j) +
                           " are both at " + text_of(points[i]) + "; remove one");
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) { return std::pair(points[i].x, points[i].y); };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(place(a), a) < std::pair(place(b), b); });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (const bool ends = order[k - 1] == 0 && order[k] + 1 == points.size();
        place(order[k - 1]) == place(order[k]) && (closed || !ends))
      throw geometry_error(name + " passes twice through " + text_of(points[order[k]]) + ", as points " +
                           std::to_string(order[k - 1]) + " and " + std::to_string(order[k]) +
                           "; divide it there");
}

/// A point that two segments share.
inline vec2 common_point(const drawn_segment& s, const drawn_segment& t) {
  const vec2 along = s.to - s.from, other = t.to - t.from;
  const double turn = cross(along, other);
  double share = 0; // of the way along the first
  if (turn != 0) {
    share = cross(t.from - s.from, other) / turn;
  } else { // the middle of what they have in common
    for (const vec2 end : {t.from, t.to})
      share += 0.5 * std::clamp(dot(end - s.from, along) / dot(along, along), 0.0, 1.0);
  }
  return s.from + std::clamp(share, 0.0, 1.0) * along;
}

[[noreturn]] inline void throw_meeting(const plane_drawing& drawing, const drawn_segment& s,
                                       const drawn_segment& t) {
  const std::string where = " near " + text_of(common_point(s, t));
  if (s.path == t.path)
    throw geometry_error(name_of_path(drawing, s.path) + " crosses itself: segments " +
                         std::to_string(s.index) + " and " + std::to_string(t.index) + where);
  throw geometry_error(name_of_path(drawing, s.path) + " and " + name_of_path(drawing, t.path) +
                       " meet at segments " + std::to_string(s.index) + " and " + std::to_string(t.index) +
                       where + "; let them touch in common points only");
}

} // namespace detail

DOVETAIL_INLINE void check_drawing(const plane_drawing& drawing) {
  if (drawing.polygons.empty())
    throw geometry_error("a plane domain needs at least one polygon; there is none");
  for (std::size_t p = 0; p < drawing.polygons.size(); ++p)
    detail::require_proper_path(drawing, p, drawing.polygons[p], true);
  for (std::size_t l = 0; l < drawing.lines.size(); ++l)
    detail::require_proper_path(drawing, drawing.polygons.size() + l, drawing.lines[l], false);
  const auto meet = [](const detail::drawn_segment& s, const detail::drawn_segment& t) {
    return detail::segments_meet(s, t);
  };
  if (const auto meeting = detail::first_meeting(detail::segments_of(drawing), meet)) {
    const auto& [s, t] = *meeting;
    detail::throw_meeting(drawing, s.path < t.path ? s : t, s.path < t.path ? t : s);
  }
}

} // namespace dovetail
