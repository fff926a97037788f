/// @file
/// A triangulation as two flat arrays over corners, and the local operations every remesher is made of.
///
/// Corner c = 3 t + i is corner i of triangle t. Its opposite side runs from the vertex of next(c) to that of
/// previous(c), with the triangle on the left; twin[c] is the corner that faces it across this side.
#pragma once

#include "dovetail/core/ids.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace dovetail {

/// Triangles, their neighbours and constrained sides. Every operation is O(1) but `collapse`, which is
/// proportional to the valence. Freed triangles are reused.
class corner_table {
public:
  std::vector<local_id> vertex;     ///< per corner; no_id in a freed triangle
  std::vector<local_id> twin;       ///< per corner; no_id across the boundary
  std::vector<local_id> constraint; ///< per corner: the segment its opposite side lies on, or no_id
  std::vector<local_id> corner_of;  ///< per vertex: one of its corners, or no_id

  /// The corner after `c` in its triangle.
  static constexpr local_id next(local_id c) { return c % 3 == 2 ? c - 2 : c + 1; }
  /// The corner before `c` in its triangle.
  static constexpr local_id previous(local_id c) { return c % 3 == 0 ? c + 2 : c - 1; }
  static constexpr local_id triangle_of(local_id c) { return c / 3; } ///< the triangle that corner `c` is of

  /// How many numbers triangles have, freed ones included.
  local_id triangle_slots() const { return static_cast<local_id>(vertex.size() / 3); }
  /// Whether triangle `t` has not been freed.
  bool alive(local_id t) const { return vertex[at(3 * t)] != no_id; }
  local_id tail(local_id c) const { return vertex[at(next(c))]; }     ///< start of the opposite side
  local_id head(local_id c) const { return vertex[at(previous(c))]; } ///< end of the opposite side
  /// True when the opposite side may be flipped, split or collapsed: not on the boundary, not constrained.
  bool free_side(local_id c) const { return twin[at(c)] != no_id && constraint[at(c)] == no_id; }

  /// A new vertex without triangles; its number.
  local_id add_vertex() {
    corner_of.push_back(no_id);
    return static_cast<local_id>(corner_of.size()) - 1;
  }

  /// Adds a triangle without neighbours.
  local_id add_triangle(local_id a, local_id b, local_id c) {
    local_id t;
    if (freed_.empty()) {
      t = triangle_slots();
      vertex.resize(vertex.size() + 3);
      twin.resize(twin.size() + 3);
      constraint.resize(constraint.size() + 3);
    } else {
      t = freed_.back();
      freed_.pop_back();
    }
    place(t, a, b, c);
    return t;
  }

  /// Makes the opposite sides of c and d one; d may be no_id.
  void glue(local_id c, local_id d) {
    twin[at(c)] = d;
    if (d != no_id)
      twin[at(d)] = c;
  }

  /// Replaces the side opposite c by the other diagonal of its quadrilateral. The new side is opposite
  /// next(c) and next(twin(c)).
  void flip(local_id c) {
    const local_id d = twin[at(c)];
    const local_id cn = next(c), cp = previous(c), dn = next(d), dp = previous(d);
    const local_id p = vertex[at(c)], q = vertex[at(d)], a = vertex[at(cn)], b = vertex[at(dn)];
    vertex[at(cp)] = q;
    vertex[at(dp)] = p;
    const local_id across_aq = twin[at(dn)], constraint_aq = constraint[at(dn)];
    const local_id across_bp = twin[at(cn)], constraint_bp = constraint[at(cn)];
    glue(c, across_aq);
    constraint[at(c)] = constraint_aq;
    glue(d, across_bp);
    constraint[at(d)] = constraint_bp;
    glue(cn, dn);
    constraint[at(cn)] = constraint[at(dn)] = no_id;
    corner_of[at(a)] = cn;
    corner_of[at(b)] = dn;
    corner_of[at(p)] = c;
    corner_of[at(q)] = d;
  }

  /// Puts vertex v inside triangle t; returns the three triangles, all with v as their last corner.
  std::array<local_id, 3> split_triangle(local_id t, local_id v) {
    const local_id a = vertex[at(3 * t)], b = vertex[at(3 * t + 1)], c = vertex[at(3 * t + 2)];
    const outer_side bc = outer(3 * t), ca = outer(3 * t + 1), ab = outer(3 * t + 2);
    const local_id t1 = add_triangle(b, c, v), t2 = add_triangle(c, a, v);
    place(t, a, b, v);
    attach(3 * t + 2, ab);
    attach(3 * t1 + 2, bc);
    attach(3 * t2 + 2, ca);
    glue(3 * t, 3 * t1 + 1);
    glue(3 * t1, 3 * t2 + 1);
    glue(3 * t2, 3 * t + 1);
    return {t, t1, t2};
  }

  /// Puts vertex v on the inner side opposite c. Both halves inherit the constraint. The four corners
  /// returned are those of v, counter-clockwise from the triangle that held c.
  std::array<local_id, 4> split_side(local_id c, local_id v) {
    const local_id d = twin[at(c)];
    const local_id p = vertex[at(c)], q = vertex[at(d)], a = tail(c), b = head(c);
    const local_id on = constraint[at(c)];
    const outer_side bp = outer(next(c)), pa = outer(previous(c));
    const outer_side aq = outer(next(d)), qb = outer(previous(d));
    const local_id t = triangle_of(c), s = triangle_of(d);
    place(t, p, a, v);
    place(s, q, b, v);
    const local_id t2 = add_triangle(b, p, v), s2 = add_triangle(a, q, v);
    attach(3 * t + 2, pa);
    attach(3 * t2 + 2, bp);
    attach(3 * s2 + 2, aq);
    attach(3 * s + 2, qb);
    glue(3 * t + 1, 3 * t2); // side (v, p)
    glue(3 * s + 1, 3 * s2); // side (v, q)
    glue(3 * t, 3 * s2 + 1); // side (a, v)
    glue(3 * s, 3 * t2 + 1); // side (b, v)
    constraint[at(3 * t)] = constraint[at(3 * s2 + 1)] = on;
    constraint[at(3 * s)] = constraint[at(3 * t2 + 1)] = on;
    return {3 * t + 2, 3 * s2 + 2, 3 * s + 2, 3 * t2 + 2};
  }

  /// The corners of v in counter-clockwise order, when v is not on the boundary; calls visit(corner).
  template <class Visit>
  void for_each_corner(local_id v, Visit visit) const {
    const local_id first = corner_of[at(v)];
    local_id c = first;
    do {
      const local_id following = counter_clockwise(c);
      visit(c);
      c = following;
    } while (c != first);
  }

  /// The corner of the same vertex in the next triangle counter-clockwise, or no_id at the boundary.
  local_id counter_clockwise(local_id c) const {
    const local_id across = twin[at(next(c))];
    return across == no_id ? no_id : next(across);
  }
  /// The corner of the same vertex in the next triangle clockwise, or no_id at the boundary.
  local_id clockwise(local_id c) const {
    const local_id across = twin[at(previous(c))];
    return across == no_id ? no_id : previous(across);
  }

  /// Moves the inner vertex v, the tail of the free side opposite c, onto its head w and removes v. The
  /// caller has made sure that the star of v, seen from w, is a valid fan.
  void collapse(local_id c) {
    const local_id v = tail(c), w = head(c), d = twin[at(c)];
    for_each_corner(v, [&](local_id corner) { vertex[at(corner)] = w; });
    // Both triangles at the side vanish; what lay across their other two sides becomes neighbours.
    zip(next(c), previous(c));
    zip(previous(d), next(d));
    release(triangle_of(c));
    release(triangle_of(d));
    corner_of[at(v)] = no_id;
  }

  /// Frees a triangle; its neighbours get a boundary there.
  void remove_triangle(local_id t) {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c)
      if (twin[at(c)] != no_id)
        twin[at(twin[at(c)])] = no_id;
    release(t);
  }

private:
  struct outer_side {
    local_id twin, constraint;
  };

  static constexpr std::size_t at(local_id i) { return static_cast<std::size_t>(i); }
  outer_side outer(local_id c) const { return {twin[at(c)], constraint[at(c)]}; }
  void attach(local_id c, outer_side side) {
    glue(c, side.twin);
    constraint[at(c)] = side.constraint;
  }
  void place(local_id t, local_id a, local_id b, local_id c) {
    const std::array<local_id, 3> v{a, b, c};
    for (local_id i = 0; i < 3; ++i) {
      vertex[at(3 * t + i)] = v[at(i)];
      twin[at(3 * t + i)] = constraint[at(3 * t + i)] = no_id;
      corner_of[at(v[at(i)])] = 3 * t + i;
    }
  }
  /// Joins what lies across two sides of a vanishing triangle.
  void zip(local_id c, local_id d) {
    const outer_side x = outer(c), y = outer(d);
    const local_id on = x.constraint != no_id ? x.constraint : y.constraint;
    if (x.twin != no_id) {
      twin[at(x.twin)] = y.twin;
      constraint[at(x.twin)] = on;
      corner_of[at(tail(x.twin))] = next(x.twin);
      corner_of[at(head(x.twin))] = previous(x.twin);
    }
    if (y.twin != no_id) {
      twin[at(y.twin)] = x.twin;
      constraint[at(y.twin)] = on;
      corner_of[at(tail(y.twin))] = next(y.twin);
      corner_of[at(head(y.twin))] = previous(y.twin);
    }
  }
  void release(local_id t) {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c)
      vertex[at(c)] = twin[at(c)] = constraint[at(c)] = no_id;
    freed_.push_back(t);
  }

  std::vector<local_id> freed_;
};

} // namespace dovetail
