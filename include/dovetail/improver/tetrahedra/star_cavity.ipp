/// @file
/// What `star_cavity.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/improver/tetrahedra/star_cavity.hpp"

#include <algorithm>
#include <array>

namespace dovetail::improvement {

DOVETAIL_INLINE bool find_outline(tet_complex& mesh, star_cavity& cavity, local_id apex) {
  mesh.clear_marks();
  for (const local_id e : cavity.elements)
    mesh.mark(e);
  cavity.outline.size = cavity.inner.size = 0;
  for (const local_id e : cavity.elements)
    for (int side = 0; side < 4; ++side) {
      if (!mesh.is_fixed(e, side) && mesh.is_marked(element_of(mesh.across(e, side))))
        continue;
      const auto& local = numbering::sides<3>[side];
      const std::array<local_id, 3> v{mesh.vertex(e, local[0]), mesh.vertex(e, local[1]),
                                      mesh.vertex(e, local[2])};
      if (std::find(v.begin(), v.end(), apex) != v.end())
        continue;
      if (!cavity.outline.push(v) || !cavity.inner.push(half_side_of(e, side)))
        return false;
    }
  return true;
}

DOVETAIL_INLINE void find_inside(const tet_complex& mesh, const star_cavity& cavity, local_id apex,
                                 bounded_list<local_id, 4 * max_cavity>& inside) {
  bounded_list<local_id, 3 * max_star> outer;
  for (const auto& side : cavity.outline)
    for (const local_id v : side)
      outer.push(v);
  std::sort(outer.begin(), outer.end());
  inside.size = 0;
  for (const local_id e : cavity.elements)
    for (const local_id v : mesh.vertices(e))
      if (v != apex && !std::binary_search(outer.begin(), outer.end(), v))
        inside.push(v);
  std::sort(inside.begin(), inside.end());
  inside.size = static_cast<int>(std::unique(inside.begin(), inside.end()) - inside.begin());
}

DOVETAIL_INLINE bool pays(const tet_complex& mesh, const local_change& change, float bad) {
  struct sums {
    int bad = 0;
    double lacking = 0;
  } before, after;
  for (const local_id e : change.old) {
    before.bad += mesh.value(e) < bad;
    before.lacking += mesh.deficit(mesh.value(e));
  }
  for (const float value : change.values) {
    after.bad += value < bad;
    after.lacking += mesh.deficit(value);
  }
  return after.bad != before.bad ? after.bad < before.bad : after.lacking < before.lacking;
}

} // namespace dovetail::improvement
