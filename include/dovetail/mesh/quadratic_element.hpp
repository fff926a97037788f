/// @file
/// Second-order elements: a node in the middle of each edge beside the corners.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dovetail {

namespace numbering {

/// `edges<D>[i]` lists the corners of edge i. Node D + 1 + i of a second-order element is on it: VTK's order.
template <int D>
inline constexpr auto edges = [] {
  if constexpr (D == 1)
    return std::array<std::array<int, 2>, 1>{{{0, 1}}};
  else if constexpr (D == 2)
    return std::array<std::array<int, 2>, 3>{{{0, 1}, {1, 2}, {2, 0}}};
  else
    return std::array<std::array<int, 2>, 6>{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
}();

/// `gmsh_nodes<D>[k]` is the node that Gmsh has in place k.
template <int D>
inline constexpr auto gmsh_nodes = [] {
  std::array<std::size_t, D + 1 + edges<D>.size()> order{};
  for (std::size_t k = 0; k < order.size(); ++k)
    order[k] = D == 3 && k >= 8 ? 17 - k : k;
  return order;
}();

} // namespace numbering

/// 3 for triangles, 6 for tetrahedra.
template <int D>
inline constexpr std::size_t edges_per_element = numbering::edges<D>.size();
/// 6 for triangles, 10 for tetrahedra.
template <int D>
inline constexpr std::size_t quadratic_nodes = static_cast<std::size_t>(D) + 1 + edges_per_element<D>;

/// Node ids of a second-order element: corners, then middles of edges.
template <int D>
using quadratic_simplex = std::array<local_id, quadratic_nodes<D>>;

/// The number of the edge with these vertices in any order among edges as in a table, or no_id. O(log edges).
inline local_id find_edge(const std::vector<simplex<1>>& edges, const simplex<1>& vertices) {
  const auto key = sorted_vertices(vertices);
  const auto at = std::lower_bound(edges.begin(), edges.end(), key);
  return at != edges.end() && *at == key ? static_cast<local_id>(at - edges.begin()) : no_id;
}
/// The vertices of an edge of an element.
template <std::size_t N>
simplex<1> vertices_of_edge(const std::array<local_id, N>& element, const std::array<int, 2>& edge) {
  return {element[edge[0]], element[edge[1]]};
}

/// The edges of a list of elements, each once.
template <int D>
struct edge_table {
  std::vector<simplex<1>> vertices; ///< ascending, and so are the edges
  /// The numbers of its edges, in the order of `numbering::edges<D>`.
  std::vector<std::array<local_id, edges_per_element<D>>> of_element;
};

/// About linear. The elements refer to points below `point_count`.
template <int D>
edge_table<D> build_edges(std::span<const simplex<D>> elements, std::size_t point_count) {
  constexpr std::size_t n = edges_per_element<D>;
  edge_table<D> table;
  table.of_element.resize(elements.size());
  for_each_group<2>(
      elements.size() * n, point_count,
      [&](std::size_t h) {
        return sorted_vertices(vertices_of_edge(elements[h / n], numbering::edges<D>[h % n]));
      },
      [&](const simplex<1>& key, std::span<const std::uint32_t> members) {
        for (const std::uint32_t h : members)
          table.of_element[h / n][h % n] = static_cast<local_id>(table.vertices.size());
        table.vertices.push_back(key);
      });
  return table;
}

/// A lower bound of the Jacobian determinant of a second-order element, over that of the element with
/// straight edges: 1 where edges are straight and halved. It is the least Bernstein coefficient, so the map
/// is one to one near every point where this is positive. In D = 2 the determinant is along the normal of the
/// straight triangle.
double least_jacobian(const std::array<vec3, quadratic_nodes<2>>& nodes);
double least_jacobian(const std::array<vec3, quadratic_nodes<3>>& nodes);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/quadratic_element.ipp"
#endif
