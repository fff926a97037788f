/// @file
/// How many tetrahedra are in walls about as thin as the size, which the integral of h^-3 does not count.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/point_sizes.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace dovetail::sizing {

/// Follows rays to the first triangle that they meet.
class ray_search {
public:
  /// \param surface triangles; it must outlive the search
  explicit ray_search(const simplicial_mesh<2>& surface);

  /// How far it is from `from` along a direction of unit length to the first triangle, or `reach` when there
  /// is none before; triangles within a millionth of that are what the ray starts from. About O(log n).
  double distance(vec3 from, vec3 direction, double reach) const;

private:
  std::array<vec3, 3> corners(std::size_t t) const {
    const auto& v = surface_.elements[t];
    return {surface_.points[v[0]], surface_.points[v[1]], surface_.points[v[2]]};
  }
  std::vector<box3> boxes() const;

  const simplicial_mesh<2>& surface_;
  box_tree tree_;
};

/// The elements of a wall with one layer of tetrahedra, less those that the integral of h^-3 has there.
/// Surfaces are sampled, the thickness found by rays. Deterministic. O(samples x log n), for n triangles.
/// \param surface oriented triangles around the domain; one with the domain on both sides comes twice, with
///   either orientation
/// \param h edge lengths, in the units of the surface
/// \param density elements of edge length 1 per unit of volume, as the integral is multiplied with
double elements_in_thin_walls(const simplicial_mesh<2>& surface, const any_sizing& h, double density);

/// Sizes of a background mesh in walls that are thinner than it: 2.5 times their thickness, and not below the
/// mesh's own. Longer elements are flat there, and interfaces among them have small angles. None where walls
/// are less than about a hundredth of the surface, in elements on it. Deterministic.
/// O(samples x log n), for n triangles.
/// \param surface as above
/// \param h edge lengths of the mesh, in the units of the surface
/// \param scale the factor between sizes of the background and the mesh
std::vector<sized_point> coarse_sizes_in_walls(const simplicial_mesh<2>& surface, const any_sizing& h,
                                               double scale);

} // namespace dovetail::sizing

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/thin_walls.ipp"
#endif
