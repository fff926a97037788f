/// @file
/// Middles of edges for meshes without a model: each off its straight edge, by what only the edge's ends say.
#pragma once

#include "dovetail/mesh/mid_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::testing {

inline vec3 bent_middle(vec3 a, vec3 b) {
  const vec3 m = midpoint(a, b);
  const double off = 0.02 * norm(b - a);
  return m + off * vec3{std::sin(50 * m.x + m.y), std::sin(50 * m.y + m.z), std::sin(50 * m.z + m.x)};
}

/// The mesh with second-order elements.
template <int D>
distributed_simplicial_mesh<D> with_bent_edges(distributed_simplicial_mesh<D> mesh) {
  auto nodes = std::make_shared<mid_edge_nodes<D>>();
  const auto bent = [](const simplex<1>& edge, std::span<const vec3> points) {
    return bent_middle(points[edge[0]], points[edge[1]]);
  };
  nodes->edges = edges_of(mesh.skeleton);
  for (const auto& edge : nodes->edges)
    nodes->points.push_back(bent(edge, mesh.skeleton.points));
  nodes->inner_points = [bent](const auto& piece, const auto& edges, const auto&) {
    std::vector<vec3> points;
    for (std::size_t k = 0; k < edges.in_skeleton.size(); ++k)
      if (edges.in_skeleton[k] == no_id)
        points.push_back(bent(edges.edges.vertices[k], piece.mesh.points));
    return points;
  };
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    const auto piece = mesh.load(static_cast<local_id>(p));
    const auto found = edges_of(piece, *nodes);
    nodes->inner.push_back(std::count(found.in_skeleton.begin(), found.in_skeleton.end(), no_id));
  }
  mesh.mid_nodes = std::move(nodes);
  return mesh;
}

} // namespace dovetail::testing
