/// @file
/// The boundary loops of a cluster of a triangulated surface, in space and in a plane.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/geometry/frame.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// A directed edge of a chart's boundary, the chart on its left.
struct boundary_edge {
  local_id from;        ///< the vertex where it starts
  local_id to;          ///< the vertex where it ends
  std::size_t triangle; ///< the triangle of the chart that has it
};

/// "No triangle": what lies across the boundary of a sheet.
inline constexpr auto nowhere = static_cast<std::size_t>(no_id);

/// Chains boundary edges of one chart to loops, turning around each vertex through the chart's triangles.
/// `across(t, i)` is the triangle across the edge opposite corner i of t, or nowhere.
template <class Across>
std::vector<std::vector<boundary_edge>>
boundary_loops(const std::vector<simplex<2>>& triangles, const std::vector<local_id>& chart_of,
               const std::vector<std::size_t>& members, Across&& across) {
  const auto key_less = [](const boundary_edge& a, const boundary_edge& b) {
    return std::tie(a.from, a.triangle, a.to) < std::tie(b.from, b.triangle, b.to);
  };
  const auto is_border = [&](std::size_t t, std::size_t next) {
    return next == nowhere || chart_of[next] != chart_of[t];
  };
  std::vector<boundary_edge> edges;
  for (const std::size_t t : members)
    for (std::size_t i = 0; i < 3; ++i)
      if (is_border(t, across(t, i)))
        edges.push_back({triangles[t][(i + 1) % 3], triangles[t][(i + 2) % 3], t});
  std::sort(edges.begin(), edges.end(), key_less);
  std::vector<char> used(edges.size(), 0);

  // From the end of an edge, turn through triangles of the chart to the boundary edge that leaves there.
  const auto next_of = [&](const boundary_edge& e) {
    std::size_t t = e.triangle;
    while (true) {
      std::size_t i = 0; // the edge of t that leaves e.to is opposite the corner before it
      while (triangles[t][(i + 1) % 3] != e.to)
        ++i;
      const std::size_t next = across(t, i);
      if (is_border(t, next))
        return boundary_edge{e.to, triangles[t][(i + 2) % 3], t};
      t = next;
    }
  };
  std::vector<std::vector<boundary_edge>> loops;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (used[first])
      continue;
    std::vector<boundary_edge> loop;
    boundary_edge at = edges[first];
    while (true) {
      const auto found = std::lower_bound(edges.begin(), edges.end(), at, key_less);
      const auto index = static_cast<std::size_t>(found - edges.begin());
      if (used[index])
        break;
      used[index] = 1;
      loop.push_back(at);
      at = next_of(at);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Do the loops bound one plane domain: one loop counter-clockwise, the others clockwise, none crossing
/// itself or another?
inline bool loops_are_simple(const std::vector<std::vector<boundary_edge>>& loops,
                             const std::vector<vec3>& points, const chart_frame& frame) {
  const auto flat = [&](local_id v) { return frame.flat(points[v]); };
  std::vector<std::pair<local_id, local_id>> segments;
  int outer = 0;
  for (const auto& loop : loops) {
    double twice_area = 0;
    for (const auto& e : loop) {
      twice_area += cross(flat(e.from) - flat(loop.front().from), flat(e.to) - flat(loop.front().from));
      segments.emplace_back(e.from, e.to);
    }
    outer += twice_area > 0 ? 1 : 0;
  }
  if (outer != 1)
    return false;
  std::vector<box3> boxes;
  for (const auto& [a, b] : segments) {
    box3 box;
    for (const vec2 p : {flat(a), flat(b)})
      box.include({p.x, p.y, 0});
    boxes.push_back(box);
  }
  const auto strictly_cross = [&](std::size_t s, std::size_t t) {
    const vec2 a = flat(segments[s].first);
    const vec2 b = flat(segments[s].second);
    const vec2 c = flat(segments[t].first);
    const vec2 d = flat(segments[t].second);
    return (cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0) &&
           (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0);
  };
  const box_tree tree(boxes);
  bool simple = true;
  for (std::size_t s = 0; s < segments.size() && simple; ++s)
    tree.for_each([&](const box3& box, std::size_t) { return simple && box.overlaps(boxes[s]); },
                  [&](local_id id) {
                    const auto t = static_cast<std::size_t>(id);
                    const auto [a, b] = segments[s];
                    const auto [c, d] = segments[t];
                    if (t > s && a != c && a != d && b != c && b != d && strictly_cross(s, t))
                      simple = false;
                  });
  return simple;
}

} // namespace dovetail::discrete
