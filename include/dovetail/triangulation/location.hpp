/// @file
/// Finding the element that holds a point by walking from a near one.
#pragma once

#include "dovetail/triangulation/triangulation.hpp"

#include <array>
#include <cstddef>

namespace dovetail::detail {

/// The element that holds `p`, its sides included, or a ghost beyond whose hull side `p` lies. Starts from
/// `start`, which is no ghost. A walk through a Delaunay triangulation across sides that `p` is strictly
/// beyond never comes back to an element (H. Edelsbrunner, doi 10.1007/BF02122779), so that it ends.
template <int D>
local_id locate(const triangulation<D>& t, const box_predicates<D>& predicates, const point_of<D>& p,
                local_id start) {
  local_id e = start, entered = no_id;
  while (!t.is_ghost(e)) {
    local_id next = no_id;
    auto corners = t.points_of(e);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (triangulation<D>::side_of(e, static_cast<local_id>(i)) == entered)
        continue;
      const auto* const corner = corners[i];
      corners[i] = &p;
      if (predicates.orientation(corners) < 0) {
        next = t[e].across[i];
        break;
      }
      corners[i] = corner;
    }
    if (next == no_id)
      return e;
    entered = next;
    e = triangulation<D>::element_of(next);
  }
  return e;
}

} // namespace dovetail::detail
