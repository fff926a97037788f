/// @file
/// What of a boundary a tetrahedrization lacks.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/native/kept_entities.hpp"
#include "dovetail/mesher/native/recovery_targets.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::detail {

/// The triangles of the boundary that are no sides of elements, each once. Linear.
inline std::vector<triangle_target> missing_triangles(const triangulation<3>& mesh,
                                                      const boundary_sides& sides) {
  std::vector<char> found(sides.entries().size(), 0);
  const auto is_of_boundary = [&](local_id v) { return sides.may_have(v); };
  for (local_id e = 0; e < static_cast<local_id>(mesh.cells.size()); ++e) {
    const auto& v = mesh[e].vertices;
    const int on_boundary =
        is_of_boundary(v[0]) + is_of_boundary(v[1]) + is_of_boundary(v[2]) + is_of_boundary(v[3]);
    if (on_boundary < 3 || !mesh.is_alive(e))
      continue;
    for (const auto& local : numbering::sides<3>) {
      const simplex<2> side{v[local[0]], v[local[1]], v[local[2]]};
      if (is_of_boundary(side[0]) && is_of_boundary(side[1]) && is_of_boundary(side[2]))
        if (const auto match = sides.find(side))
          found[match.entry] = 1;
    }
  }
  std::vector<triangle_target> missing;
  for (const auto& t : sides.triangles())
    if (char& is_found = found[sides.find(t).entry]; is_found == 0) {
      is_found = 1; // one listed in both directions is one
      missing.push_back({t});
    }
  return missing;
}

/// Those of `lacking`, and of the triangles that take the place of others, that are kept and no sides of
/// elements; what is kept and there is not taken away. Linear in them.
inline std::vector<triangle_target> still_missing(local_changes& changes,
                                                  const std::vector<triangle_target>& lacking,
                                                  const kept_entities& kept) {
  std::vector<triangle_target> missing;
  for (const triangle_target& target : lacking)
    if (const auto& t = target.corners; kept.has(t[0], t[1], t[2]) && !target.is_there(changes))
      missing.push_back(target);
  kept.for_each_new_triangle([&](const simplex<2>& t) {
    if (const triangle_target target{t}; !target.is_there(changes))
      missing.push_back(target);
  });
  return missing;
}

/// The edges of these triangles that are none of the tetrahedrization, in growing order: all that are missing
/// of a boundary of which these are, for where an edge is missing its triangles are.
inline std::vector<edge_target> missing_edges_of(local_changes& changes,
                                                 const std::vector<triangle_target>& triangles) {
  std::vector<vertex_pair> edges;
  for (const auto& [t] : triangles)
    for (const auto& local : numbering::sides<2>)
      edges.push_back(sorted_pair(t[local[0]], t[local[1]]));
  sort_unique(edges);
  std::vector<edge_target> missing;
  for (const vertex_pair& edge : edges)
    if (const edge_target target{edge}; !target.is_there(changes))
      missing.push_back(target);
  return missing;
}

} // namespace dovetail::detail
