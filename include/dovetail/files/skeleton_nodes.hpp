/// @file
/// Which nodes of the skeleton the subdomains have.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/mid_nodes.hpp"
#include "dovetail/mesh/skeleton_index.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::io {

/// Calls `take(node)` for the nodes of a side of the skeleton: its points, and the middles of its edges where
/// the mesh has any.
template <int D, class Take>
void for_each_node(const distributed_simplicial_mesh<D>& mesh, const simplex<D - 1>& side, const Take& take) {
  for (const local_id v : side)
    take(v);
  if (!mesh.mid_nodes)
    return;
  const auto first = static_cast<local_id>(mesh.skeleton.points.size());
  for (const auto& local : numbering::edges<D - 1>)
    take(first + find_edge(mesh.mid_nodes->edges, vertices_of_edge(side, local)));
}

/// Of each subdomain, how many nodes of the skeleton are on its sides. O(sides + nodes + subdomains), and of
/// second-order elements a search per edge. Throws `mesh_error` as `sides_by_subdomain`.
template <int D>
std::vector<local_id> count_skeleton_nodes(const distributed_simplicial_mesh<D>& mesh) {
  const sides_by_subdomain<D> sides(mesh);
  std::vector<local_id> seen(skeleton_nodes(mesh), no_id); // the last subdomain that has it
  std::vector<local_id> counts;
  for (local_id s = 0; static_cast<std::size_t>(s) < mesh.counts.size(); ++s) {
    local_id count = 0;
    for (const local_id t : sides[s])
      for_each_node(mesh, mesh.skeleton.sides[t], [&](local_id node) {
        local_id& last = seen[node];
        count += last == s ? 0 : 1;
        last = s;
      });
    counts.push_back(count);
  }
  return counts;
}

} // namespace dovetail::io
