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
  bool alive(local_id t) const { return vertex[3 * t] != no_id; }
  local_id tail(local_id c) const { return vertex[next(c)]; }     ///< start of the opposite side
  local_id head(local_id c) const { return vertex[previous(c)]; } ///< end of the opposite side
  /// True when the opposite side may be flipped, split or collapsed: not on the boundary, not constrained.
  bool free_side(local_id c) const { return twin[c] != no_id && constraint[c] == no_id; }

  /// A new vertex without triangles; its number.
  local_id add_vertex() {
    corner_of.push_back(no_id);
    return static_cast<local_id>(corner_of.size()) - 1;
  }

  /// Adds a triangle without neighbours.
  local_id add_triangle(local_id a, local_id b, local_id c);

  /// Makes the opposite sides of c and d one; d may be no_id.
  void glue(local_id c, local_id d) {
    twin[c] = d;
    if (d != no_id)
      twin[d] = c;
  }

  /// Replaces the side opposite c by the other diagonal of its quadrilateral. The new side is opposite
  /// next(c) and next(twin(c)).
  void flip(local_id c);

  /// Puts vertex v inside triangle t; returns the three triangles, all with v as their last corner.
  std::array<local_id, 3> split_triangle(local_id t, local_id v);

  /// Puts vertex v on the inner side opposite c. Both halves inherit the constraint. The four corners
  /// returned are those of v, counter-clockwise from the triangle that held c.
  std::array<local_id, 4> split_side(local_id c, local_id v);

  /// The corners of v in counter-clockwise order, when v is not on the boundary; calls visit(corner).
  template <class Visit>
  void for_each_corner(local_id v, Visit visit) const {
    const local_id first = corner_of[v];
    local_id c = first;
    do {
      const local_id following = counter_clockwise(c);
      visit(c);
      c = following;
    } while (c != first);
  }

  /// The corner of the same vertex in the next triangle counter-clockwise, or no_id at the boundary.
  local_id counter_clockwise(local_id c) const {
    const local_id across = twin[next(c)];
    return across == no_id ? no_id : next(across);
  }
  /// The corner of the same vertex in the next triangle clockwise, or no_id at the boundary.
  local_id clockwise(local_id c) const {
    const local_id across = twin[previous(c)];
    return across == no_id ? no_id : previous(across);
  }

  /// Moves the inner vertex v, the tail of the free side opposite c, onto its head w and removes v. The
  /// caller has made sure that the star of v, seen from w, is a valid fan.
  void collapse(local_id c);

  /// Frees a triangle; its neighbours get a boundary there.
  void remove_triangle(local_id t);

private:
  struct outer_side {
    local_id twin, constraint;
  };

  outer_side outer(local_id c) const { return {twin[c], constraint[c]}; }
  void attach(local_id c, outer_side side) {
    glue(c, side.twin);
    constraint[c] = side.constraint;
  }
  void place(local_id t, local_id a, local_id b, local_id c);
  /// Joins what lies across two sides of a vanishing triangle.
  void zip(local_id c, local_id d);
  void release(local_id t) {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c)
      vertex[c] = twin[c] = constraint[c] = no_id;
    freed_.push_back(t);
  }

  std::vector<local_id> freed_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/corner_table.ipp"
#endif
