/// @file
/// Flips, splits and collapses on the triangulation of a surface, each leaving it valid.
///
/// They are written for any state that has a corner table and geometry: remesh's `patch_state` (valid in a
/// parameter plane), the improver's `surface_complex` (valid in space). What a state `s` offers:
///
/// - `s.table`: corner_table; `s.point[v]`, `s.normal[v]` (unit, or zero), `s.inner(v)`: v may be moved
/// - `s.quality(a, b, c)`: what flips and moves raise; negative for a triangle that faces the wrong way
/// - `s.positive(a, b, c)`, `s.may_flip(c)`, `s.may_collapse(v, w)`: whether the result would be valid
/// - `s.relative_length(a, b)`: edge length over target length
/// - `s.add_middle(c)`: a new vertex for the side opposite c, or no_id
/// - `s.displaced(v, step, link)`: where a step takes v, or nothing; `s.location_of(v)`, `s.place(v, l)`
/// - `s.tangent(v)`: a unit vector of the surface; `s.ring_scratch()`: a list kept between calls
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/corner_table.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace dovetail::detail {

/// Flips free sides by a rule until it holds around the queued corners. Reuse one object: it owns its queue.
class flip_queue {
public:
  void push(local_id c) { corners_.push_back(c); }

  /// Delaunay in 3-space: opposite angles add up to at most pi. Returns the number of flips.
  template <class State>
  std::size_t make_delaunay(State& s) {
    return run(s, [&](local_id c) { return violates_delaunay(s, c) && !flip_folds(s, c); });
  }
  /// Flips whatever raises the smaller quality of the two triangles; never loops, as that strictly grows.
  template <class State>
  std::size_t raise_quality(State& s, bool allow_chords = true) {
    return run(s,
               [&](local_id c) { return (allow_chords || !makes_chord(s, c)) && flip_raises_quality(s, c); });
  }
  template <class State>
  void push_all(const State& s) {
    const auto& t = s.table;
    for (local_id c = 0; c < static_cast<local_id>(t.vertex.size()); ++c)
      if (t.vertex[c] != no_id && t.twin[c] > c)
        push(c);
  }

  /// Would the smaller quality of the two triangles at the side opposite c grow?
  template <class State>
  static bool flip_raises_quality(const State& s, local_id c) {
    const local_id d = s.table.twin[c];
    const local_id p = s.table.vertex[c], q = s.table.vertex[d];
    const local_id a = s.table.tail(c), b = s.table.head(c);
    const double before = std::min(s.quality(p, a, b), s.quality(q, b, a));
    return before < 0.74 && std::min(s.quality(p, a, q), s.quality(q, b, p)) > before + 1e-6;
  }

private:
  template <class State>
  static bool makes_chord(const State& s, local_id c) {
    return !s.inner(s.table.vertex[c]) && !s.inner(s.table.vertex[s.table.twin[c]]);
  }
  template <class State>
  static bool violates_delaunay(const State& s, local_id c) {
    const local_id d = s.table.twin[c];
    const local_id p = s.table.vertex[c], q = s.table.vertex[d];
    const local_id a = s.table.tail(c), b = s.table.head(c);
    const vec3 pa = s.point[a] - s.point[p], pb = s.point[b] - s.point[p];
    const vec3 qa = s.point[a] - s.point[q], qb = s.point[b] - s.point[q];
    // Angles have the sign of their triangle's orientation. Where one is inside out the angles mean nothing,
    // but a flip that makes things better is welcome.
    const vec3 normal = s.normal[a] + s.normal[b];
    const vec3 area_p = cross(pa, pb), area_q = cross(qb, qa);
    if (dot(area_p, normal) < 0 || dot(area_q, normal) < 0)
      return flip_raises_quality(s, c);
    const double cos_p = dot(pa, pb), cos_q = dot(qa, qb);
    if (cos_p >= 0 && cos_q >= 0)
      return false;
    const double sine_of_sum = norm(area_p) * cos_q + cos_p * norm(area_q);
    return sine_of_sum <
           -1e-9 * (norm_squared(pa) + norm_squared(pb)) * (norm_squared(qa) + norm_squared(qb));
  }
  /// True when a flip would make a triangle whose normal is wrong out of two whose normals are right.
  template <class State>
  static bool flip_folds(const State& s, local_id c) {
    const local_id d = s.table.twin[c];
    const local_id p = s.table.vertex[c], q = s.table.vertex[d];
    const local_id a = s.table.tail(c), b = s.table.head(c);
    const double after = std::min(s.quality(p, a, q), s.quality(q, b, p));
    return after <= 0 && after <= std::min(s.quality(p, a, b), s.quality(q, b, a));
  }
  template <class State, class Rule>
  std::size_t run(State& s, Rule wants_flip) {
    std::size_t flips = 0;
    const std::size_t limit = 40 * corners_.size() + 1000; // the Delaunay rule may cycle on a curved surface
    while (!corners_.empty()) {
      const local_id c = corners_.back();
      corners_.pop_back();
      if (s.table.vertex[c] == no_id || !s.table.free_side(c) || flips > limit)
        continue;
      if (!wants_flip(c) || !s.may_flip(c))
        continue;
      const local_id d = s.table.twin[c];
      s.table.flip(c);
      ++flips;
      for (const local_id e : {c, corner_table::previous(c), d, corner_table::previous(d)})
        corners_.push_back(e);
    }
    return flips;
  }

  std::vector<local_id> corners_;
};

/// Splits the free side opposite c in its middle. Returns the new vertex, or no_id when its ends are too
/// close for a valid split.
template <class State>
local_id split_at_middle(State& s, local_id c, flip_queue& flips) {
  const local_id v = s.add_middle(c);
  if (v != no_id)
    for (const local_id e : s.table.split_side(c, v))
      flips.push(e);
  return v;
}

/// The star of an inner vertex as pairs (tail, head) of its link, counter-clockwise.
template <class State>
void collect_link(const State& s, local_id v, std::vector<std::array<local_id, 2>>& link) {
  link.clear();
  s.table.for_each_corner(v, [&](local_id c) { link.push_back({s.table.tail(c), s.table.head(c)}); });
}

/// The smallest quality in the star of an inner vertex.
template <class State>
double star_quality(const State& s, local_id v) {
  double least = 1;
  s.table.for_each_corner(
      v, [&](local_id c) { least = std::min(least, s.quality(v, s.table.tail(c), s.table.head(c))); });
  return least;
}

/// The smallest quality that the fan over the star of v, seen from its neighbour w, would have; -3 when the
/// fan is not valid in the parameter plane or has an edge longer than `longest` times its target.
template <class State>
double quality_after_collapse(const State& s, local_id v, local_id w, double longest) {
  double least = 1;
  s.table.for_each_corner(v, [&](local_id c) {
    const local_id a = s.table.tail(c), b = s.table.head(c);
    if (a == w || b == w || least < -2)
      return;
    if (!s.positive(w, a, b) || s.relative_length(w, a) > longest) {
      least = -3;
      return;
    }
    least = std::min(least, s.quality(w, a, b));
  });
  return least;
}

/// Removes inner vertex v by moving it onto a neighbour: the one that leaves the best star, when that is
/// better than `required`. True when removed.
template <class State>
bool remove_vertex(State& s, local_id v, double required, double longest, flip_queue& flips) {
  double best = required;
  local_id onto = no_id;
  s.table.for_each_corner(v, [&](local_id c) {
    const double q = quality_after_collapse(s, v, s.table.tail(c), longest);
    if (q > best && s.may_collapse(v, s.table.tail(c))) {
      best = q;
      onto = c; // tail(c) is the target: the side v -> tail(c) is opposite previous(c)
    }
  });
  if (onto == no_id)
    return false;
  const local_id w = s.table.tail(onto);
  // previous(onto) sees the side from v's corner to the tail: tail = v, head = w.
  const local_id c = corner_table::previous(onto);
  const local_id first = s.table.counter_clockwise(onto);
  std::vector<local_id>& ring = s.ring_scratch();
  ring.clear();
  for (local_id e = first; e != onto; e = s.table.counter_clockwise(e))
    ring.push_back(e);
  s.table.collapse(c);
  for (const local_id e : ring)
    if (s.table.vertex[e] == w) {
      flips.push(corner_table::next(e));
      flips.push(corner_table::previous(e));
      flips.push(e);
    }
  return true;
}

} // namespace dovetail::detail
