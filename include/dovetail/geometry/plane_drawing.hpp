/// @file
/// What a plane domain is made from: closed polygons and open lines, and the checks that they must pass.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

/// A polygon (closed: the last point is joined to the first, and not repeated) or an open line.
struct plane_path {
  std::vector<vec2> points;
  std::string name = {};
};

/// Polygons bound the domain: what lies inside an odd number of them is meshed, so a polygon in another one
/// is a hole, and one in that hole an island. Lines lie inside the domain; the mesh has edges along them.
/// Paths may touch in common points only.
struct plane_drawing {
  std::vector<plane_path> polygons;
  std::vector<plane_path> lines;
};

namespace detail {

/// A segment of a drawing. Paths are numbered polygons first.
struct drawn_segment {
  vec2 from, to;
  std::size_t path = 0;
  std::size_t index = 0; ///< within its path
};

inline std::string name_of_path(const plane_drawing& drawing, std::size_t path) {
  const bool polygon = path < drawing.polygons.size();
  const std::size_t index = polygon ? path : path - drawing.polygons.size();
  const std::string& name = (polygon ? drawing.polygons : drawing.lines)[index].name;
  return (polygon ? "polygon " : "line ") + std::to_string(index) + (name.empty() ? "" : " '" + name + "'");
}

inline std::string text_of(vec2 p) {
  return std::string("(").append(std::to_string(p.x)).append(", ").append(std::to_string(p.y)).append(")");
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

inline double signed_area(const std::vector<vec2>& polygon) {
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

/// Whether c, on the line through a and b, lies between them or at one.
inline bool lies_between(vec2 a, vec2 b, vec2 c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y &&
         c.y <= std::max(a.y, b.y);
}

/// Whether two segments have more in common than a common end; exact.
inline bool segments_meet(const drawn_segment& s, const drawn_segment& t) {
  const double t0 = orient2d(s.from, s.to, t.from), t1 = orient2d(s.from, s.to, t.to);
  const double s0 = orient2d(t.from, t.to, s.from), s1 = orient2d(t.from, t.to, s.to);
  const auto is_end = [](const drawn_segment& of, vec2 p) { return p == of.from || p == of.to; };
  const auto touches = [&](const drawn_segment& of, double side, vec2 p) {
    return side == 0 && lies_between(of.from, of.to, p) && !is_end(of, p);
  };
  if (touches(s, t0, t.from) || touches(s, t1, t.to) || touches(t, s0, s.from) || touches(t, s1, s.to))
    return true;
  if (is_end(s, t.from) && is_end(s, t.to))
    return true;
  return ((t0 > 0 && t1 < 0) || (t0 < 0 && t1 > 0)) && ((s0 > 0 && s1 < 0) || (s0 < 0 && s1 > 0));
}

[[noreturn]] inline void throw_meeting(const plane_drawing& drawing, const drawn_segment& s,
                                       const drawn_segment& t) {
  const std::string where = " near " + text_of(0.5 * (t.from + t.to));
  if (s.path == t.path)
    throw geometry_error(name_of_path(drawing, s.path) + " crosses itself: segments " +
                         std::to_string(s.index) + " and " + std::to_string(t.index) + where);
  throw geometry_error(name_of_path(drawing, s.path) + " and " + name_of_path(drawing, t.path) +
                       " meet at segments " + std::to_string(s.index) + " and " + std::to_string(t.index) +
                       where + "; let them touch in common points only");
}

/// A sweep over x; about n log n for segments that are short beside the drawing.
inline void require_no_crossings(const plane_drawing& drawing, std::vector<drawn_segment> segments) {
  const auto left = [](const drawn_segment& s) { return std::min(s.from.x, s.to.x); };
  const auto right = [](const drawn_segment& s) { return std::max(s.from.x, s.to.x); };
  std::sort(segments.begin(), segments.end(), [&](const drawn_segment& a, const drawn_segment& b) {
    return std::tuple(left(a), a.path, a.index) < std::tuple(left(b), b.path, b.index);
  });
  std::vector<const drawn_segment*> active;
  for (const drawn_segment& s : segments) {
    active.erase(std::remove_if(active.begin(), active.end(),
                                [&](const drawn_segment* a) { return right(*a) < left(s); }),
                 active.end());
    for (const drawn_segment* a : active) {
      const bool apart = std::max(a->from.y, a->to.y) < std::min(s.from.y, s.to.y) ||
                         std::max(s.from.y, s.to.y) < std::min(a->from.y, a->to.y);
      if (!apart && segments_meet(*a, s))
        throw_meeting(drawing, a->path < s.path ? *a : s, a->path < s.path ? s : *a);
    }
    active.push_back(&s);
  }
}

} // namespace detail

/// Throws `geometry_error` that names the path and its points when a drawing bounds no proper domain: too few
/// or repeated points, a polygon without area, paths that cross or overlap.
inline void check_drawing(const plane_drawing& drawing) {
  if (drawing.polygons.empty())
    throw geometry_error("a plane domain needs at least one polygon; there is none");
  for (std::size_t p = 0; p < drawing.polygons.size(); ++p)
    detail::require_proper_path(drawing, p, drawing.polygons[p], true);
  for (std::size_t l = 0; l < drawing.lines.size(); ++l)
    detail::require_proper_path(drawing, drawing.polygons.size() + l, drawing.lines[l], false);
  detail::require_no_crossings(drawing, detail::segments_of(drawing));
}

} // namespace dovetail
