/// @file
/// Elements of second order as they are read, and the mesh of first order that their corners make.
#pragma once

#include "dovetail/files/merge_points.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace dovetail::io {

namespace detail {

/// Appends an element, whose nodes are in VTK's order; of first order only the corners are there.
template <int D>
void append_element(const quadratic_simplex<D>& nodes, bool quadratic, std::vector<simplex<D>>& elements,
                    std::vector<std::array<local_id, edges_per_element<D>>>& middles) {
  std::copy_n(nodes.begin(), D + 1, elements.emplace_back().begin());
  if (quadratic)
    std::copy(nodes.begin() + D + 1, nodes.end(), middles.emplace_back().begin());
}

/// Whether the elements or triangles of a mesh are of second order, some at least.
inline bool has_middles(const loaded_mesh& mesh) {
  return !mesh.middles.empty() || !mesh.triangle_middles.empty();
}

} // namespace detail

/// The mesh of first order on the points that are corners of tetrahedra or triangles, in their order. Arrays
/// of points are left out. O(mesh). Throws nothing but for a lack of memory.
/// \param mesh of which some or all elements may be of second order
inline loaded_mesh corners_of(const loaded_mesh& mesh) {
  loaded_mesh corners = mesh;
  corners.middles.clear();
  corners.triangle_middles.clear();
  corners.point_scalars.clear();
  corners.point_fields.clear();
  std::vector<local_id> place(mesh.mesh.points.size(), no_id), kept;
  const auto use = [&](const auto& simplices) {
    for (const auto& vertices : simplices)
      for (const local_id v : vertices)
        place[v] = 0;
  };
  use(mesh.mesh.elements);
  use(mesh.triangles);
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] != no_id) {
      place[v] = static_cast<local_id>(kept.size());
      kept.push_back(static_cast<local_id>(v));
    }
  const auto renumber = [&](auto& simplices) {
    for (auto& vertices : simplices)
      for (local_id& v : vertices)
        v = place[v];
  };
  renumber(corners.mesh.elements);
  renumber(corners.triangles);
  corners.mesh.points = detail::chosen(mesh.mesh.points, kept);
  if (!mesh.node_ids.empty())
    corners.node_ids = detail::chosen(mesh.node_ids, kept);
  return corners;
}

} // namespace dovetail::io
