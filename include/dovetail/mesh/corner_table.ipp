/// @file
/// What `corner_table.hpp` declares.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/corner_table.hpp"

#include <array>

namespace dovetail {

DOVETAIL_INLINE local_id corner_table::add_triangle(local_id a, local_id b, local_id c) {
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

DOVETAIL_INLINE void corner_table::flip(local_id c) {
  const local_id d = twin[c];
  const local_id cn = next(c), cp = previous(c), dn = next(d), dp = previous(d);
  const local_id p = vertex[c], q = vertex[d], a = vertex[cn], b = vertex[dn];
  vertex[cp] = q;
  vertex[dp] = p;
  const local_id across_aq = twin[dn], constraint_aq = constraint[dn];
  const local_id across_bp = twin[cn], constraint_bp = constraint[cn];
  glue(c, across_aq);
  constraint[c] = constraint_aq;
  glue(d, across_bp);
  constraint[d] = constraint_bp;
  glue(cn, dn);
  constraint[cn] = constraint[dn] = no_id;
  corner_of[a] = cn;
  corner_of[b] = dn;
  corner_of[p] = c;
  corner_of[q] = d;
}

DOVETAIL_INLINE std::array<local_id, 3> corner_table::split_triangle(local_id t, local_id v) {
  const local_id a = vertex[3 * t], b = vertex[3 * t + 1], c = vertex[3 * t + 2];
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

DOVETAIL_INLINE std::array<local_id, 4> corner_table::split_side(local_id c, local_id v) {
  const local_id d = twin[c];
  const local_id p = vertex[c], q = vertex[d], a = tail(c), b = head(c);
  const local_id on = constraint[c];
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
  constraint[3 * t] = constraint[3 * s2 + 1] = on;
  constraint[3 * s] = constraint[3 * t2 + 1] = on;
  return {3 * t + 2, 3 * s2 + 2, 3 * s + 2, 3 * t2 + 2};
}

DOVETAIL_INLINE void corner_table::collapse(local_id c) {
  const local_id v = tail(c), w = head(c), d = twin[c];
  for_each_corner(v, [&](local_id corner) { vertex[corner] = w; });
  // Both triangles at the side vanish; what lay across their other two sides becomes neighbours.
  zip(next(c), previous(c));
  zip(previous(d), next(d));
  release(triangle_of(c));
  release(triangle_of(d));
  corner_of[v] = no_id;
}

DOVETAIL_INLINE void corner_table::remove_triangle(local_id t) {
  for (local_id c = 3 * t; c < 3 * t + 3; ++c)
    if (twin[c] != no_id)
      twin[twin[c]] = no_id;
  release(t);
}

DOVETAIL_INLINE void corner_table::place(local_id t, local_id a, local_id b, local_id c) {
  const std::array<local_id, 3> v{a, b, c};
  for (local_id i = 0; i < 3; ++i) {
    vertex[3 * t + i] = v[i];
    twin[3 * t + i] = constraint[3 * t + i] = no_id;
    corner_of[v[i]] = 3 * t + i;
  }
}

DOVETAIL_INLINE void corner_table::zip(local_id c, local_id d) {
  const outer_side x = outer(c), y = outer(d);
  const local_id on = x.constraint != no_id ? x.constraint : y.constraint;
  if (x.twin != no_id) {
    twin[x.twin] = y.twin;
    constraint[x.twin] = on;
    corner_of[tail(x.twin)] = next(x.twin);
    corner_of[head(x.twin)] = previous(x.twin);
  }
  if (y.twin != no_id) {
    twin[y.twin] = x.twin;
    constraint[y.twin] = on;
    corner_of[tail(y.twin)] = next(y.twin);
    corner_of[head(y.twin)] = previous(y.twin);
  }
}

} // namespace dovetail
