/// @file
/// The sides of a decomposed mesh that bound its parts.
#pragma once

#include "dovetail/mesh/adjacency.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dovetail_test {

using namespace dovetail;

/// Boundary sides in growing order of side number, held once. The same shape as the skeleton's triangles.
template <int D>
struct subdomain_boundary_sides {
  std::vector<simplex<D - 1>> sides;               ///< oriented outwards of `subdomains[0]`
  std::vector<std::array<local_id, 2>> subdomains; ///< {smaller, larger}, or {part, no_id} on the boundary
  std::vector<local_id> side_ids;                  ///< in the mesh's side table
  std::vector<std::uint8_t> on_surface; ///< 1: boundary of the mesh or change of tag (fixed by the CAD)
};

/// Collects the sides between different parts and on the boundary of the mesh. A non-manifold side is held
/// once per element, with no_id on its other side. Linear.
template <int D>
subdomain_boundary_sides<D> subdomain_boundary(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                               std::span<const local_id> part_of_element) {
  subdomain_boundary_sides<D> found;
  const auto part = [&](local_id e) { return part_of_element[e]; };
  const auto add = [&](const simplex<D - 1>& vertices, std::array<local_id, 2> both, local_id side,
                       bool fixed) {
    found.sides.push_back(vertices);
    found.subdomains.push_back(both);
    found.side_ids.push_back(side);
    found.on_surface.push_back(fixed ? 1 : 0);
  };
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto side = static_cast<local_id>(s);
    const auto [first, second] = sides.elements[s];
    if (!sides.is_interior(side)) {
      for (const local_id e : sides.all_elements(side)) {
        const auto& of_element = sides.of_element[e];
        std::size_t local = 0;
        while (of_element[local] != side)
          ++local;
        add(dovetail::detail::pick(mesh.elements[e], numbering::sides<D>[local]), {part(e), no_id}, side,
            true);
      }
      continue;
    }
    if (part(first) == part(second))
      continue;
    simplex<D - 1> vertices = sides.vertices[s]; // outwards of `first`
    const bool swap = part(second) < part(first);
    if (swap)
      std::swap(vertices[0], vertices[1]);
    const bool material = !mesh.tags.empty() && mesh.tags[first] != mesh.tags[second];
    add(vertices, swap ? std::array{part(second), part(first)} : std::array{part(first), part(second)}, side,
        material);
  }
  return found;
}

} // namespace dovetail_test
