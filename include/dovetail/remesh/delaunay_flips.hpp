/// @file
/// Flips that make a triangulation of the plane Delaunay.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/mesh/corner_table.hpp"

#include <vector>

namespace dovetail::detail {

/// Flips the sides opposite the queued corners, and those that their flips expose, until all are Delaunay or
/// constrained. Empties the queue. Exact.
/// \param xy the place of a vertex in the plane
template <class Place>
void flip_to_delaunay(corner_table& table, const Place& xy, std::vector<local_id>& corners) {
  while (!corners.empty()) {
    const local_id c = corners.back();
    corners.pop_back();
    if (!table.free_side(c))
      continue;
    const local_id d = table.twin[c];
    if (in_circle(xy(table.vertex[c]), xy(table.tail(c)), xy(table.head(c)), xy(table.vertex[d])) <= 0)
      continue;
    table.flip(c); // inside the circle implies strictly convex
    for (const local_id e : {c, corner_table::previous(c), d, corner_table::previous(d)})
      corners.push_back(e);
  }
}

} // namespace dovetail::detail
