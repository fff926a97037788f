/// @file
/// Closedness and volumes of a triangulated model.
#pragma once

#include "dovetail/geometry/concepts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace dovetail::testing {

/// Signed volume of each solid, enclosed by a triangulation.
inline std::vector<double> enclosed_volumes(const geometry_topology& topology, const surface_mesh& surface) {
  std::vector<double> volumes(topology.solids.size(), 0.0);
  for (std::size_t t = 0; t < surface.mesh.elements.size(); ++t) {
    const auto& e = surface.mesh.elements[t];
    const auto corner = [&](std::size_t k) { return surface.mesh.points[e[k]]; };
    const double volume = signed_volume({0, 0, 0}, corner(0), corner(1), corner(2));
    const auto& face = topology.faces[surface.mesh.tags[t]];
    volumes[face.solids[0]] += volume;
    if (face.solids[1] != no_id)
      volumes[face.solids[1]] -= volume;
  }
  return volumes;
}

/// Triangle edges that the triangles around one solid pass more often in one direction than in the other.
inline int open_edges(const geometry_topology& topology, const surface_mesh& surface) {
  int open = 0;
  for (std::size_t solid = 0; solid < topology.solids.size(); ++solid) {
    std::map<std::array<local_id, 2>, int> balance;
    for (std::size_t t = 0; t < surface.mesh.elements.size(); ++t) {
      const auto& sides = topology.faces[surface.mesh.tags[t]].solids;
      const int inside = sides[0] == static_cast<local_id>(solid) ? 1 : 0;
      const int outside = sides[1] == static_cast<local_id>(solid) ? 1 : 0;
      const auto& e = surface.mesh.elements[t];
      for (std::size_t k = 0; inside != outside && k < 3; ++k) {
        const local_id a = e[k], b = e[(k + 1) % 3];
        balance[{std::min(a, b), std::max(a, b)}] += (a < b) == (inside > 0) ? 1 : -1;
      }
    }
    for (const auto& [edge, sum] : balance)
      open += sum != 0 ? 1 : 0;
  }
  return open;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const auto& line : lines)
    all += line + "\n";
  return all;
}

} // namespace dovetail::testing
