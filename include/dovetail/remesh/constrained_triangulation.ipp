/// @file
/// What `constrained_triangulation.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/corner_table.hpp"
#include "dovetail/remesh/constrained_triangulation.hpp"
#include "dovetail/remesh/point_triangulation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Builds a `loop_triangulation`; see `triangulate_loops`.
class loop_triangulator {
public:
  loop_triangulator(std::span<const vec2> points, std::span<const std::array<local_id, 2>> segments)
      : triangulation_(points), segments_(segments) {}

  loop_triangulation run() {
    net_.assign(segments_.size(), 0);
    for (local_id s = 0; s < static_cast<local_id>(segments_.size()); ++s)
      recover_segment(s);
    if (result_.crossings.empty())
      remove_outside();
    result_.table = std::move(triangulation_.table);
    result_.same_as = std::move(triangulation_.same_as);
    return std::move(result_);
  }

private:
  vec2 xy(local_id v) const { return triangulation_.xy(v); }
  corner_table& table() { return triangulation_.table; }
  const corner_table& table() const { return triangulation_.table; }
  local_id enclosing() const { return triangulation_.enclosing(); }
  local_id first_of_equal(local_id v) const { return triangulation_.same_as[v]; }

  /// Makes segment s a constrained side, or reports what it crosses.
  void recover_segment(local_id s) {
    const local_id a = first_of_equal(segments_[s][0]);
    const local_id b = first_of_equal(segments_[s][1]);
    if (a == b) {
      result_.crossings.push_back({s, s});
      return;
    }
    std::vector<local_id>& crossed = crossed_;
    crossed.clear();
    const local_id start = first_step(a, b, s);
    if (start == no_id)
      return;
    if (table().head(start) == b || table().tail(start) == b) {
      constrain(start, b, s);
      return;
    }
    if (!collect_crossed(start, a, b, s))
      return;
    flip_crossed(a, b, s);
  }

  /// The corner of `a` whose triangle the segment to b enters, or that has b as a neighbour; no_id when the
  /// segment passes exactly through another vertex.
  local_id first_step(local_id a, local_id b, local_id s) {
    local_id found = no_id, blocked = no_id;
    table().for_each_corner(a, [&](local_id c) {
      const local_id p = table().tail(c), q = table().head(c);
      if (p == b || q == b) {
        found = c;
        return;
      }
      const double left_of_p = orient2d(xy(a), xy(p), xy(b)), left_of_q = orient2d(xy(a), xy(q), xy(b));
      if (left_of_p > 0 && left_of_q < 0 && found == no_id)
        found = c;
      if (left_of_p == 0 && dot(xy(p) - xy(a), xy(b) - xy(a)) > 0)
        blocked = p;
    });
    if (found == no_id && blocked != no_id)
      report_touched(s, blocked);
    return found;
  }

  /// Collects the sides that the segment from a to b crosses, as pairs of vertices; false when it hits a
  /// constraint or a vertex, which is reported.
  bool collect_crossed(local_id start, local_id a, local_id b, local_id s) {
    local_id c = start;
    for (;;) {
      if (table().constraint[c] != no_id) {
        result_.crossings.push_back({table().constraint[c], s});
        return false;
      }
      crossed_.push_back(c);
      const local_id d = table().twin[c], apex = table().vertex[d];
      if (apex == b)
        return true;
      const double side = orient2d(xy(a), xy(b), xy(apex));
      if (side == 0) {
        report_touched(s, apex);
        return false;
      }
      c = separates(corner_table::next(d), a, b) ? corner_table::next(d) : corner_table::previous(d);
    }
  }
  bool separates(local_id c, local_id a, local_id b) const {
    return (orient2d(xy(a), xy(b), xy(table().tail(c))) > 0) !=
           (orient2d(xy(a), xy(b), xy(table().head(c))) > 0);
  }

  void flip_crossed(local_id a, local_id b, local_id s) {
    // A flip keeps the ids of the two triangles but renames sides, so a crossed side is found by vertices.
    std::vector<std::array<local_id, 2>>& queue = crossed_sides_;
    queue.clear();
    for (const local_id c : crossed_)
      queue.push_back({table().tail(c), table().head(c)});
    std::size_t head = 0, refused = 0;
    created_.clear();
    while (head < queue.size() && refused < queue.size() - head + 1) {
      const auto [p, q] = queue[head++];
      const local_id c = corner_opposite(p, q);
      const local_id d = table().twin[c];
      const local_id x = table().vertex[c], y = table().vertex[d];
      const bool convex =
          orient2d(xy(x), xy(table().tail(c)), xy(y)) > 0 && orient2d(xy(y), xy(table().head(c)), xy(x)) > 0;
      if (!convex) {
        queue.push_back({p, q});
        ++refused;
        continue;
      }
      refused = 0;
      table().flip(c);
      const bool still_crosses = x != a && x != b && y != a && y != b &&
                                 (orient2d(xy(a), xy(b), xy(x)) > 0) != (orient2d(xy(a), xy(b), xy(y)) > 0);
      if (still_crosses)
        queue.push_back({x, y});
      else
        created_.push_back({x, y});
    }
    const local_id c = corner_opposite(a, b);
    if (c == no_id) { // cannot happen with exact predicates; reported rather than trusted
      result_.crossings.push_back({s, s});
      return;
    }
    constrain_side(c, s);
    for (const auto& [x, y] : created_)
      if (const local_id e = corner_opposite(x, y); e != no_id)
        legalise_.push_back(e);
    triangulation_.restore_delaunay(legalise_);
  }

  /// The corner whose opposite side joins p and q, in either direction; no_id when they are not neighbours.
  local_id corner_opposite(local_id p, local_id q) const {
    if (p >= enclosing()) // its fan is not closed; no segment crosses a side of the enclosing triangle
      std::swap(p, q);
    local_id found = no_id;
    table().for_each_corner(p, [&](local_id c) {
      if (table().tail(c) == q)
        found = corner_table::previous(c);
    });
    return found;
  }

  void constrain(local_id corner_at_a, local_id b, local_id s) {
    const local_id c = table().tail(corner_at_a) == b ? corner_table::previous(corner_at_a)
                                                      : corner_table::next(corner_at_a);
    constrain_side(c, s);
  }

  /// Marks a side as lying on segment s; a side that two segments share keeps the first and their sum.
  void constrain_side(local_id c, local_id s) {
    local_id& mine = table().constraint[c];
    if (mine == no_id)
      mine = table().constraint[table().twin[c]] = s;
    net_[mine] += start_of(mine) == start_of(s) ? 1 : -1;
  }
  local_id start_of(local_id s) const { return first_of_equal(segments_[s][0]); }

  void report_touched(local_id s, local_id v) {
    local_id other = s;
    table().for_each_corner(v, [&](local_id c) {
      for (const local_id side : {corner_table::next(c), corner_table::previous(c)})
        if (table().constraint[side] != no_id)
          other = table().constraint[side];
    });
    if (other == s) // the touched segment has not been recovered yet
      for (local_id k = 0; k < static_cast<local_id>(segments_.size()) && other == s; ++k)
        for (const local_id end : segments_[k])
          if (k != s && first_of_equal(end) == v)
            other = k;
    result_.crossings.push_back({std::min(s, other), std::max(s, other)});
  }

  /// Keeps the triangles of winding number one.
  void remove_outside() {
    std::vector<std::int32_t> winding(table().triangle_slots(), unknown);
    std::vector<local_id> stack{corner_table::triangle_of(table().corner_of[enclosing()])};
    winding[stack[0]] = 0;
    while (!stack.empty()) {
      const local_id t = stack.back();
      stack.pop_back();
      for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
        const local_id d = table().twin[c];
        if (d == no_id || winding[corner_table::triangle_of(d)] != unknown)
          continue;
        const local_id s = table().constraint[d];
        int step = 0;
        if (s != no_id)
          step = table().tail(d) == start_of(s) ? net_[s] : -net_[s];
        winding[corner_table::triangle_of(d)] = winding[t] + step;
        stack.push_back(corner_table::triangle_of(d));
      }
    }
    report_misplaced(winding);
    for (local_id t = 0; t < table().triangle_slots(); ++t)
      if (winding[t] != 1)
        table().remove_triangle(t);
    refresh_vertices();
  }

  void report_misplaced(const std::vector<std::int32_t>& winding) {
    for (local_id c = 0; c < static_cast<local_id>(table().vertex.size()); ++c)
      if (const local_id s = table().constraint[c]; s != no_id) {
        const std::int32_t w = winding[corner_table::triangle_of(c)];
        const std::int32_t across = winding[corner_table::triangle_of(table().twin[c])];
        if ((w != 0 && w != 1) || (w == 0 && across == 0)) // the latter: a slit outside
          result_.misplaced.push_back(s);
      }
    sort_unique(result_.misplaced);
  }

  void refresh_vertices() {
    table().corner_of.assign(enclosing(), no_id);
    for (local_id c = 0; c < static_cast<local_id>(table().vertex.size()); ++c)
      if (const local_id v = table().vertex[c]; v != no_id)
        table().corner_of[v] = c;
  }

  static constexpr std::int32_t unknown = -1000000;

  point_triangulation triangulation_;
  std::span<const std::array<local_id, 2>> segments_;
  loop_triangulation result_;
  std::vector<std::int32_t> net_; // per segment on a side: segments along it minus segments against it
  std::vector<local_id> legalise_, crossed_;
  std::vector<std::array<local_id, 2>> crossed_sides_, created_;
};

} // namespace detail

DOVETAIL_INLINE loop_triangulation triangulate_loops(std::span<const vec2> points,
                                                     std::span<const std::array<local_id, 2>> segments) {
  return detail::loop_triangulator(points, segments).run();
}

} // namespace dovetail
