/// @file
/// What is in the way of an edge or a triangle that shall become one of a tetrahedrization.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace dovetail::detail {

/// Whether the line through a and b passes through the inside of the triangle (u, v, w).
inline bool line_pierces(vec3 a, vec3 b, vec3 u, vec3 v, vec3 w) {
  const double first = orient3d(a, b, u, v);
  if (first == 0)
    return false;
  const double second = orient3d(a, b, v, w), third = orient3d(a, b, w, u);
  return first > 0 ? second > 0 && third > 0 : second < 0 && third < 0;
}

/// Whether the segments cross in a point inside of both.
inline bool segments_cross(vec3 a, vec3 b, vec3 u, vec3 v) {
  // Far from each other, as nearly all are that lie in one plane, which is where orientations are dear.
  for (int axis = 0; axis < 3; ++axis)
    if (std::max(a[axis], b[axis]) < std::min(u[axis], v[axis]) ||
        std::max(u[axis], v[axis]) < std::min(a[axis], b[axis]))
      return false;
  if (orient3d(a, b, u, v) != 0)
    return false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto flat = [axis](vec3 p) { return vec2{p[(axis + 1) % 3], p[(axis + 2) % 3]}; };
    const double su = orient2d(flat(a), flat(b), flat(u)), sv = orient2d(flat(a), flat(b), flat(v));
    if (su == 0 || sv == 0)
      continue;
    const double sa = orient2d(flat(u), flat(v), flat(a)), sb = orient2d(flat(u), flat(v), flat(b));
    return (su > 0) != (sv > 0) && sa != 0 && sb != 0 && (sa > 0) != (sb > 0);
  }
  return false;
}

/// Whether `p` lies between the ends of the segment.
inline bool is_on_segment(vec3 a, vec3 b, vec3 p) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto flat = [axis](vec3 q) { return vec2{q[(axis + 1) % 3], q[(axis + 2) % 3]}; };
    if (orient2d(flat(a), flat(b), flat(p)) != 0)
      return false;
  }
  for (int axis = 0; axis < 3; ++axis)
    if (a[axis] != b[axis])
      return std::min(a[axis], b[axis]) < p[axis] && p[axis] < std::max(a[axis], b[axis]);
  return false;
}

/// Whether `p` lies inside of a triangle that has an area.
inline bool is_in_triangle(vec3 a, vec3 b, vec3 c, vec3 p) {
  if (orient3d(a, b, c, p) != 0)
    return false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto flat = [axis](vec3 q) { return vec2{q[(axis + 1) % 3], q[(axis + 2) % 3]}; };
    const double whole = orient2d(flat(a), flat(b), flat(c));
    if (whole == 0)
      continue;
    const double u = orient2d(flat(a), flat(b), flat(p)), v = orient2d(flat(b), flat(c), flat(p)),
                 w = orient2d(flat(c), flat(a), flat(p));
    return whole > 0 ? u > 0 && v > 0 && w > 0 : u < 0 && v < 0 && w < 0;
  }
  return false;
}

/// A target is present, or there are edges and sides of elements in its way. Each weighs something; a change
/// is good when what it makes weighs less than what it takes away.
struct edge_target {
  std::array<local_id, 2> ends;

  local_id begin() const { return ends[0]; }
  vec3 middle(const local_changes& c) const { return midpoint(c.point(ends[0]), c.point(ends[1])); }
  bool is_there(local_changes& changes) const { return changes.element_with_edge(ends[0], ends[1]) != no_id; }
  bool passes_through(const local_changes& c, local_id v) const {
    return !is_end(v) && is_on_segment(c.point(ends[0]), c.point(ends[1]), c.point(v));
  }
  int weight(const local_changes& c, local_id u, local_id v) const {
    c.count_work();
    constexpr int edge_weight = 2; // an edge crossed is about as bad as two sides pierced next to it
    return !is_end(u) && !is_end(v) &&
                   segments_cross(c.point(ends[0]), c.point(ends[1]), c.point(u), c.point(v))
               ? edge_weight
               : 0;
  }
  int weight(const local_changes& c, local_id u, local_id v, local_id w) const {
    c.count_work();
    if (is_end(u) || is_end(v) || is_end(w))
      return 0;
    const vec3 a = c.point(ends[0]), b = c.point(ends[1]), pu = c.point(u), pv = c.point(v), pw = c.point(w);
    const double sa = orient3d(pu, pv, pw, a), sb = orient3d(pu, pv, pw, b);
    return sa != 0 && sb != 0 && (sa > 0) != (sb > 0) && line_pierces(a, b, pu, pv, pw);
  }

private:
  bool is_end(local_id v) const { return v == ends[0] || v == ends[1]; }
};

/// A triangle whose edges are there: edges pass through its inside.
struct triangle_target {
  simplex<2> corners;

  local_id begin() const { return corners[0]; }
  vec3 middle(const local_changes& c) const {
    return (c.point(corners[0]) + c.point(corners[1]) + c.point(corners[2])) / 3;
  }
  bool is_there(local_changes& changes) const {
    return changes.has_triangle(corners[0], corners[1], corners[2]);
  }
  bool passes_through(const local_changes& c, local_id v) const {
    return v != corners[0] && v != corners[1] && v != corners[2] &&
           is_in_triangle(c.point(corners[0]), c.point(corners[1]), c.point(corners[2]), c.point(v));
  }
  int weight(const local_changes& c, local_id u, local_id v) const {
    c.count_work();
    for (const local_id corner : corners)
      if (u == corner || v == corner)
        return 0;
    const vec3 pa = c.point(corners[0]), pb = c.point(corners[1]), pc = c.point(corners[2]), pu = c.point(u),
               pv = c.point(v);
    const double su = orient3d(pa, pb, pc, pu), sv = orient3d(pa, pb, pc, pv);
    return su != 0 && sv != 0 && (su > 0) != (sv > 0) && line_pierces(pu, pv, pa, pb, pc);
  }
  int weight(const local_changes&, local_id, local_id, local_id) const { return 0; }
};

/// The edges and sides in the way of a target.
struct obstacles {
  std::vector<std::array<local_id, 2>> edges; ///< each once, lower vertex first
  std::vector<local_id> sides;                ///< one of the two sides
  std::vector<local_id> elements;             ///< those at them
};

/// Goes along a target from its first vertex and calls `f` with each element there that is no ghost.
template <class Target, class F>
void for_each_along(local_changes& changes, const Target& target, const F& f) {
  const auto crosses = [&](local_id e, std::size_t i) {
    if (changes.mesh().is_ghost(e))
      return false;
    const auto [u, v, w] = changes.side_vertices(e, i);
    return target.weight(changes, u, v, w) > 0 || target.weight(changes, u, v) > 0 ||
           target.weight(changes, v, w) > 0 || target.weight(changes, w, u) > 0;
  };
  const auto visit = [&](local_id e) {
    if (!changes.mesh().is_ghost(e))
      f(e);
  };
  changes.spread_from(target.begin(), visit, crosses);
}

/// Finds what is in the way of a target.
template <class Target>
void find_obstacles(local_changes& changes, const Target& target, obstacles& found) {
  found.edges.clear();
  found.sides.clear();
  found.elements.clear();
  const auto& mesh = changes.mesh();
  for_each_along(changes, target, [&](local_id e) {
    bool touched = false;
    for (const auto& ridge : numbering::ridges<3>) {
      const local_id u = mesh[e].vertices[ridge[0]], v = mesh[e].vertices[ridge[1]];
      if (target.weight(changes, u, v) == 0)
        continue;
      found.edges.push_back({std::min(u, v), std::max(u, v)});
      touched = true;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [u, v, w] = changes.side_vertices(e, i);
      if (target.weight(changes, u, v, w) == 0)
        continue;
      const local_id side = triangulation<3>::side_of(e, static_cast<local_id>(i));
      found.sides.push_back(std::min(side, mesh.across(side)));
      touched = true;
    }
    if (touched)
      found.elements.push_back(e);
  });
  sort_unique(found.edges);
  sort_unique(found.sides);
}

/// The vertices that a target passes through, in growing order.
template <class Target>
std::vector<local_id> vertices_within(local_changes& changes, const Target& target) {
  std::vector<local_id> result;
  for_each_along(changes, target, [&](local_id e) {
    for (const local_id v : changes.mesh()[e].vertices)
      if (target.passes_through(changes, v))
        result.push_back(v);
  });
  sort_unique(result);
  return result;
}

} // namespace dovetail::detail
