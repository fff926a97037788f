/// @file
/// Flips, splits and collapses on a `patch_state`, each leaving a valid triangulation.
#pragma once

#include "dovetail/remesh/patch_state.hpp"

namespace dovetail::detail {

/// Flips free sides by a rule until it holds around the queued corners. Reuse one object: it owns its queue.
class flip_queue {
public:
  void push(local_id c) { corners_.push_back(c); }

  /// Delaunay in 3-space: opposite angles add up to at most pi. Returns the number of flips.
  template <class S>
  std::size_t make_delaunay(patch_state<S>& s) {
    return run(s, [&](local_id c) { return violates_delaunay(s, c) && !flip_folds(s, c); });
  }
  /// Flips whatever raises the smaller quality of the two triangles; never loops, as that strictly grows.
  template <class S>
  std::size_t raise_quality(patch_state<S>& s, bool allow_chords = true) {
    return run(s,
               [&](local_id c) { return (allow_chords || !makes_chord(s, c)) && flip_raises_quality(s, c); });
  }
  template <class S>
  void push_all(const patch_state<S>& s) {
    const auto& t = s.table;
    for (local_id c = 0; c < static_cast<local_id>(t.vertex.size()); ++c)
      if (t.vertex[static_cast<std::size_t>(c)] != no_id && t.twin[static_cast<std::size_t>(c)] > c)
        push(c);
  }

private:
  template <class S>
  static bool makes_chord(const patch_state<S>& s, local_id c) {
    return !s.inner(s.table.vertex[s.at(c)]) && !s.inner(s.table.vertex[s.at(s.table.twin[s.at(c)])]);
  }
  template <class S>
  static bool violates_delaunay(const patch_state<S>& s, local_id c) {
    const local_id d = s.table.twin[s.at(c)];
    const local_id p = s.table.vertex[s.at(c)], q = s.table.vertex[s.at(d)];
    const local_id a = s.table.tail(c), b = s.table.head(c);
    const vec3 pa = s.point[s.at(a)] - s.point[s.at(p)], pb = s.point[s.at(b)] - s.point[s.at(p)];
    const vec3 qa = s.point[s.at(a)] - s.point[s.at(q)], qb = s.point[s.at(b)] - s.point[s.at(q)];
    // Angles have the sign of their triangle's orientation. Where one is inside out the angles mean nothing,
    // but a flip that makes things better is welcome.
    const vec3 normal = s.normal[s.at(a)] + s.normal[s.at(b)];
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
  template <class S>
  static bool flip_folds(const patch_state<S>& s, local_id c) {
    const local_id d = s.table.twin[s.at(c)];
    const local_id p = s.table.vertex[s.at(c)], q = s.table.vertex[s.at(d)];
    const local_id a = s.table.tail(c), b = s.table.head(c);
    const double after = std::min(s.quality(p, a, q), s.quality(q, b, p));
    return after <= 0 && after <= std::min(s.quality(p, a, b), s.quality(q, b, a));
  }
  template <class S>
  static bool flip_raises_quality(const patch_state<S>& s, local_id c) {
    const local_id d = s.table.twin[s.at(c)];
    const local_id p = s.table.vertex[s.at(c)], q = s.table.vertex[s.at(d)];
    const local_id a = s.table.tail(c), b = s.table.head(c);
    const double before = std::min(s.quality(p, a, b), s.quality(q, b, a));
    return before < 0.74 && std::min(s.quality(p, a, q), s.quality(q, b, p)) > before + 1e-6;
  }

  template <class S, class Rule>
  std::size_t run(patch_state<S>& s, Rule wants_flip) {
    std::size_t flips = 0;
    const std::size_t limit = 40 * corners_.size() + 1000; // the Delaunay rule may cycle on a curved surface
    while (!corners_.empty()) {
      const local_id c = corners_.back();
      corners_.pop_back();
      if (s.table.vertex[s.at(c)] == no_id || !s.table.free_side(c) || flips > limit)
        continue;
      if (!wants_flip(c) || !s.may_flip(c))
        continue;
      const local_id d = s.table.twin[s.at(c)];
      s.table.flip(c);
      ++flips;
      for (const local_id e : {c, corner_table::previous(c), d, corner_table::previous(d)})
        corners_.push_back(e);
    }
    return flips;
  }

  std::vector<local_id> corners_;
};

/// Splits the free side opposite c at the middle of its parameters. Returns the new vertex, or no_id when the
/// parameters are too close for a valid split.
template <class S>
local_id split_at_middle(patch_state<S>& s, local_id c, flip_queue& flips) {
  const local_id d = s.table.twin[s.at(c)];
  const local_id a = s.table.tail(c), b = s.table.head(c);
  const vec2 middle = 0.5 * (s.xy[s.at(a)] + s.xy[s.at(b)]);
  const vec2 p = s.xy[s.at(s.table.vertex[s.at(c)])], q = s.xy[s.at(s.table.vertex[s.at(d)])];
  const vec2 ax = s.xy[s.at(a)], bx = s.xy[s.at(b)];
  if (!(orient2d(p, ax, middle) > 0 && orient2d(bx, p, middle) > 0 && orient2d(q, bx, middle) > 0 &&
        orient2d(ax, q, middle) > 0))
    return no_id;
  const surface_frame f = s.frame_at(middle);
  const local_id v = s.add_vertex(middle, f, s.target(a, b));
  for (const local_id e : s.table.split_side(c, v))
    flips.push(e);
  return v;
}

/// The star of an inner vertex as pairs (tail, head) of its link, counter-clockwise.
template <class S>
void collect_link(const patch_state<S>& s, local_id v, std::vector<std::array<local_id, 2>>& link) {
  link.clear();
  s.table.for_each_corner(v, [&](local_id c) { link.push_back({s.table.tail(c), s.table.head(c)}); });
}

/// The smallest quality in the star of an inner vertex.
template <class S>
double star_quality(const patch_state<S>& s, local_id v) {
  double least = 1;
  s.table.for_each_corner(
      v, [&](local_id c) { least = std::min(least, s.quality(v, s.table.tail(c), s.table.head(c))); });
  return least;
}

/// The smallest quality that the fan over the star of v, seen from its neighbour w, would have; -3 when the
/// fan is not valid in the parameter plane or has an edge longer than `longest` times its target.
template <class S>
double quality_after_collapse(const patch_state<S>& s, local_id v, local_id w, double longest) {
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
template <class S>
bool remove_vertex(patch_state<S>& s, local_id v, double required, double longest, flip_queue& flips) {
  double best = required;
  local_id onto = no_id;
  s.table.for_each_corner(v, [&](local_id c) {
    const double q = quality_after_collapse(s, v, s.table.tail(c), longest);
    if (q > best) {
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
    if (s.table.vertex[s.at(e)] == w) {
      flips.push(corner_table::next(e));
      flips.push(corner_table::previous(e));
      flips.push(e);
    }
  return true;
}

} // namespace dovetail::detail
