#pragma once

#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/background_mesh.hpp"

#include <array>
#include <utility>

namespace dovetail_test {

using namespace dovetail;

/// The unit cube as 6 n^3 tetrahedra; its surface is six CAD faces, its edges twelve CAD curves.
inline background_mesh cube(int n) {
  background_mesh mesh;
  const auto id = [&](int i, int j, int k) { return static_cast<local_id>((k * (n + 1) + j) * (n + 1) + i); };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.volume.points.push_back({1.0 * i / n, 1.0 * j / n, 1.0 * k / n});
  constexpr std::array<std::array<int, 3>, 6> axis_orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (std::size_t order = 0; order < 6; ++order) {
          std::array<int, 3> at{i, j, k};
          simplex<3> element{id(i, j, k), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[axis_orders[order][step]];
            element[step + 1] = id(at[0], at[1], at[2]);
          }
          if (order >= 3) // odd permutations of the axes are mirrored
            std::swap(element[2], element[3]);
          mesh.volume.elements.push_back(element);
          mesh.volume.tags.push_back(0);
        }
  const auto sides = build_sides(mesh.volume);
  surface_mesh& surface = mesh.surface;
  surface.mesh.points = mesh.volume.points;
  surface.vertex_hosts.resize(surface.mesh.points.size());
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s))) {
      const auto& t = sides.vertices[s];
      const auto at = [&](std::size_t corner) { return surface.mesh.points[t[corner]]; };
      local_id face = 0;
      for (int axis = 0; axis < 3; ++axis)
        for (const double wall : {0.0, 1.0})
          if (at(0)[axis] == wall && at(1)[axis] == wall && at(2)[axis] == wall)
            face = static_cast<local_id>(2 * axis + (wall > 0 ? 1 : 0));
      surface.mesh.elements.push_back(t);
      surface.mesh.tags.push_back(face);
      surface.corner_uv.emplace_back();
    }
  const auto edges = build_sides(surface.mesh);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.elements[e];
    if (surface.mesh.tags[a] != surface.mesh.tags[b])
      surface.curve_edges.push_back({edges.vertices[e], 0, {0, 1}});
  }
  return mesh;
}

} // namespace dovetail_test
