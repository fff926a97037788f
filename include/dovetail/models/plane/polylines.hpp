/// @file
/// From a checked drawing to curves between corners, and to the faces that they bound.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/plane/drawing.hpp"
#include "dovetail/models/plane/polyline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// The curves of a drawing: those of its polygons in order, then those of its lines.
struct plane_polylines {
  std::vector<polyline> curves;               ///< polygons first
  std::vector<std::array<local_id, 2>> ends;  ///< vertices of each curve
  std::vector<vec2> vertices;                 ///< where curves end
  std::vector<std::vector<local_id>> of_path; ///< curves of each path, polygons first, in its order
};

namespace detail {

/// Which points of a path are ends of curves. `uses` counts how often a place occurs in the drawing.
inline std::vector<bool> corners_of(const plane_path& path, bool closed, double corner_deg,
                                    const std::map<std::pair<double, double>, int>& uses) {
  const auto& points = path.points;
  const std::size_t n = points.size();
  std::vector<bool> corner(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    if (uses.at({points[i].x, points[i].y}) > 1 || (!closed && (i == 0 || i + 1 == n))) {
      corner[i] = true;
      continue;
    }
    const vec2 in = points[i] - points[(i + n - 1) % n], out = points[(i + 1) % n] - points[i];
    corner[i] = std::abs(std::atan2(cross(in, out), dot(in, out))) * 180 / std::numbers::pi > corner_deg;
  }
  if (std::none_of(corner.begin(), corner.end(), [](bool c) { return c; }))
    corner[0] = true;
  return corner;
}

/// Whether a point is inside a polygon; the ray to the right.
inline bool is_inside(const std::vector<vec2>& polygon, vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y > p.y) == (b.y > p.y))
      continue;
    const double side = orient2d(a, b, p);
    if ((b.y > a.y) == (side > 0))
      inside = !inside;
  }
  return inside;
}

/// The middle of a path's first segment: on no other path.
inline vec2 probe_of(const plane_path& path) {
  return 0.5 * (path.points[0] + path.points[1]);
}

/// The polygons around a place, outermost first (nested ones have growing depth).
inline std::vector<std::size_t> polygons_around(const plane_drawing& drawing, vec2 p, std::size_t but) {
  std::vector<std::size_t> around;
  for (std::size_t q = 0; q < drawing.polygons.size(); ++q)
    if (q != but && is_inside(drawing.polygons[q].points, p))
      around.push_back(q);
  std::sort(around.begin(), around.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(signed_area(drawing.polygons[a].points)) >
           std::abs(signed_area(drawing.polygons[b].points));
  });
  return around;
}

} // namespace detail

/// Divides the paths of a checked drawing at their corners.
inline plane_polylines divide_at_corners(const plane_drawing& drawing, double corner_deg) {
  std::map<std::pair<double, double>, int> uses;
  for (const auto* paths : {&drawing.polygons, &drawing.lines})
    for (const plane_path& path : *paths)
      for (const vec2 p : path.points)
        ++uses[{p.x, p.y}];
  plane_polylines made;
  std::map<std::pair<double, double>, local_id> vertex_at;
  const auto vertex = [&](vec2 p) {
    const auto [found, is_new] =
        vertex_at.try_emplace({p.x, p.y}, static_cast<local_id>(made.vertices.size()));
    if (is_new)
      made.vertices.push_back(p);
    return found->second;
  };
  const auto divide = [&](const plane_path& path, bool closed) {
    const auto corner = detail::corners_of(path, closed, corner_deg, uses);
    const std::size_t n = path.points.size();
    const auto first =
        static_cast<std::size_t>(std::find(corner.begin(), corner.end(), true) - corner.begin());
    std::vector<local_id> curves;
    std::vector<vec2> points{path.points[first]};
    for (std::size_t k = 1; k < n + (closed ? 1 : 0); ++k) {
      const std::size_t i = (first + k) % n;
      points.push_back(path.points[i]);
      if (!corner[i])
        continue;
      made.ends.push_back({vertex(points.front()), vertex(points.back())});
      curves.push_back(static_cast<local_id>(made.curves.size()));
      made.curves.emplace_back(std::move(points));
      points = {path.points[i]};
    }
    made.of_path.push_back(std::move(curves));
  };
  for (const plane_path& polygon : drawing.polygons)
    divide(polygon, true);
  for (const plane_path& line : drawing.lines)
    divide(line, false);
  return made;
}

/// The faces between the curves of a drawing. A polygon inside an even number of others starts a face, one
/// inside an odd number is a hole. Throws `geometry_error` naming a line outside of all faces.
inline geometry_topology make_plane_topology(const plane_drawing& drawing, const plane_polylines& parts,
                                             const std::vector<polyline>& curves) {
  geometry_topology topology;
  for (const vec2 p : parts.vertices)
    topology.vertices.push_back({{p.x, p.y, 0}});
  const auto name_of_curve = [&](local_id c) {
    for (std::size_t path = 0; path < parts.of_path.size(); ++path)
      if (const auto& own = parts.of_path[path]; std::find(own.begin(), own.end(), c) != own.end())
        return path < drawing.polygons.size() ? drawing.polygons[path].name
                                              : drawing.lines[path - drawing.polygons.size()].name;
    return std::string();
  };
  for (std::size_t c = 0; c < curves.size(); ++c)
    topology.curves.push_back({.vertices = parts.ends[c],
                               .t = {0, curves[c].length()},
                               .name = name_of_curve(static_cast<local_id>(c))});

  using coedge = geometry_topology::coedge;
  std::vector<local_id> face_of_polygon(drawing.polygons.size(), no_id);
  std::vector<std::vector<std::size_t>> around(drawing.polygons.size());
  for (std::size_t p = 0; p < around.size(); ++p) {
    around[p] = detail::polygons_around(drawing, detail::probe_of(drawing.polygons[p]), p);
    if (around[p].size() % 2 == 1)
      continue;
    face_of_polygon[p] = static_cast<local_id>(topology.faces.size());
    topology.faces.emplace_back().name = drawing.polygons[p].name;
  }
  const auto add_loop = [&](local_id face, std::vector<coedge> loop) {
    auto& at = topology.faces[face];
    at.coedges.insert(at.coedges.end(), loop.begin(), loop.end());
    at.loops.push_back(std::move(loop));
  };
  for (std::size_t p = 0; p < around.size(); ++p) {
    const bool hole = around[p].size() % 2 == 1;
    const bool reversed = (detail::signed_area(drawing.polygons[p].points) > 0) == hole;
    std::vector<coedge> loop;
    for (const local_id c : parts.of_path[p])
      loop.push_back({c, reversed});
    if (reversed)
      std::reverse(loop.begin(), loop.end());
    add_loop(face_of_polygon[hole ? around[p].back() : p], std::move(loop));
  }
  for (std::size_t l = 0; l < drawing.lines.size(); ++l) {
    const auto inside =
        detail::polygons_around(drawing, detail::probe_of(drawing.lines[l]), drawing.polygons.size());
    if (inside.size() % 2 == 0)
      throw geometry_error(detail::name_of_path(drawing, drawing.polygons.size() + l) +
                           " lies outside of the domain; remove it");
    for (const local_id c : parts.of_path[drawing.polygons.size() + l])
      add_loop(face_of_polygon[inside.back()], {{c, false}, {c, true}});
  }
  return topology;
}

} // namespace dovetail
