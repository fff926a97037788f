/// @file
/// Checks that hold for every coarse surface mesh.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesher/checks.hpp"

#include <algorithm>
#include <map>

namespace dovetail::test {

/// Directed edges that lack their opposite, counted over the closed surfaces of all solids.
inline std::size_t open_edges(const surface_mesh& surface, const geometry_topology& topology) {
  std::size_t open = 0;
  for (local_id solid = 0; solid < static_cast<local_id>(topology.solids.size()); ++solid) {
    std::map<std::array<local_id, 2>, int> balance;
    for (std::size_t e = 0; e < surface.mesh.elements.size(); ++e) {
      const auto& face = topology.faces[surface.mesh.tags[e]];
      const int sense = face.solids[0] == solid ? 1 : face.solids[1] == solid ? -1 : 0;
      const auto& t = surface.mesh.elements[e];
      for (std::size_t i = 0; i < 3 && sense != 0; ++i) {
        const local_id a = t[i], b = t[(i + 1) % 3];
        balance[{std::min(a, b), std::max(a, b)}] += a < b ? sense : -sense;
      }
    }
    for (const auto& [edge, count] : balance)
      open += count != 0;
  }
  return open;
}

inline double volume_of(const surface_mesh& surface) {
  return enclosed_volume(surface.mesh.points, surface.mesh.elements);
}

/// The largest distance between a vertex and where its face's parameters put it (curve tolerances included).
template <geometry_model G>
double parameter_error(const surface_mesh& surface, const G& model) {
  double worst = 0;
  for (std::size_t e = 0; e < surface.mesh.elements.size(); ++e)
    for (std::size_t i = 0; i < 3; ++i)
      worst = std::max(worst, distance(surface.mesh.points[surface.mesh.elements[e][i]],
                                       model.face_point(surface.mesh.tags[e], surface.corner_uv[e][i])));
  return worst;
}

/// Mesh edges that occur in more than two triangles.
inline std::size_t crowded_edges(const surface_mesh& surface) {
  std::map<std::array<local_id, 2>, int> count;
  for (const auto& t : surface.mesh.elements)
    for (std::size_t i = 0; i < 3; ++i)
      ++count[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}];
  std::size_t crowded = 0;
  for (const auto& [edge, n] : count)
    crowded += n > 2;
  return crowded;
}

} // namespace dovetail::test
