/// @file
/// How many tetrahedra are in walls about as thin as the size, which the integral of h^-3 does not count.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/erased.hpp"

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

/// The largest factor of at most `wanted`, and at least 1, by which sizes of a background mesh may be
/// enlarged: elements more than 2.5 times as long as walls are thick are flat, and interfaces among them have
/// small angles. A fifth of the elements may be in such walls. Deterministic. O(samples x log n), for n
/// triangles.
/// \param surface as above
/// \param h edge lengths of the mesh, in the units of the surface
/// \param density as above
/// \param elements of the mesh, about
/// \param wanted the factor without regard to walls
double scale_within_walls(const simplicial_mesh<2>& surface, const any_sizing& h, double density,
                          double elements, double wanted);

} // namespace dovetail::sizing

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/thin_walls.ipp"
#endif
