/// @file
/// What of a boundary a tetrahedrization lacks.
#pragma once

#include "dovetail/mesher/native/kept_entities.hpp"
#include "dovetail/mesher/native/recovery_targets.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dovetail::detail {

/// The edges of a boundary that are none of a tetrahedrization. Linear.
inline std::vector<edge_target> missing_edges_of(const triangulation<3>& mesh, const kept_entities& kept) {
  const auto& edges = kept.edges();
  std::vector<char> found(edges.size(), 0);
  for (local_id e = 0; e < static_cast<local_id>(mesh.cells.size()); ++e) {
    if (!mesh.is_alive(e))
      continue;
    for (const auto& ridge : numbering::ridges<3>) {
      const local_id u = mesh[e].vertices[static_cast<std::size_t>(ridge[0])],
                     v = mesh[e].vertices[static_cast<std::size_t>(ridge[1])];
      if (!kept.is_of_boundary(u) || !kept.is_of_boundary(v))
        continue;
      const auto edge = sorted_pair(u, v);
      const auto place = std::lower_bound(edges.begin(), edges.end(), edge);
      if (place != edges.end() && *place == edge)
        found[static_cast<std::size_t>(place - edges.begin())] = 1;
    }
  }
  std::vector<edge_target> missing;
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k] == 0)
      missing.push_back({edges[k]});
  return missing;
}

/// The triangles kept that are no sides of elements. Linear.
inline std::vector<triangle_target> missing_triangles_of(local_changes& changes, const kept_entities& kept) {
  std::vector<char> found(kept.sides().entries().size(), 0);
  const auto& mesh = changes.mesh();
  for (local_id e = 0; e < static_cast<local_id>(mesh.cells.size()); ++e)
    for (std::size_t i = 0; i < 4 && mesh.is_alive(e); ++i) {
      const auto side = changes.side_vertices(e, i);
      if (kept.is_of_boundary(side[0]) && kept.is_of_boundary(side[1]) && kept.is_of_boundary(side[2]))
        if (const auto match = kept.sides().find(side))
          found[at(match.entry)] = 1;
    }
  std::vector<triangle_target> missing;
  for (const auto& t : kept.triangles())
    if (found[at(kept.sides().find(t).entry)] == 0 && kept.has(t[0], t[1], t[2]))
      missing.push_back({t});
  kept.for_each_new_triangle([&](const simplex<2>& t) {
    if (const triangle_target target{t}; !target.is_there(changes))
      missing.push_back(target);
  });
  return missing;
}

} // namespace dovetail::detail
