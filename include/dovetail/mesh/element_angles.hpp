/// @file
/// The angles of one triangle or tetrahedron.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace dovetail {

inline constexpr double degrees_per_radian = 180.0 / std::numbers::pi; ///< to turn radians into degrees

/// Coordinates of the corners of an element.
template <std::size_t N>
std::array<vec3, N> corners(std::span<const vec3> points, const std::array<local_id, N>& vertices) {
  std::array<vec3, N> at;
  for (std::size_t k = 0; k < N; ++k)
    at[k] = points[vertices[k]];
  return at;
}

/// Angles of a triangle at its corners, in degrees.
inline std::array<double, 3> dihedral_angles(const std::array<vec3, 3>& p) {
  const vec3 ab = p[1] - p[0];
  const vec3 bc = p[2] - p[1];
  const vec3 ca = p[0] - p[2];
  const double twice_area = norm(cross(ab, bc));
  const auto angle = [&](vec3 in, vec3 out) {
    return degrees_per_radian * std::atan2(twice_area, -dot(in, out));
  };
  return {angle(ca, ab), angle(ab, bc), angle(bc, ca)};
}

/// The smallest corner angle of a triangle, in degrees: the one opposite the shortest edge.
inline double smallest_corner_angle(const std::array<vec3, 3>& p) {
  std::array<vec3, 3> edges; // edge k is opposite corner k, from corner k + 1 to corner k + 2
  std::size_t shortest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    edges[k] = p[(k + 2) % 3] - p[(k + 1) % 3];
    if (norm_squared(edges[k]) < norm_squared(edges[shortest]))
      shortest = k;
  }
  const vec3 in = edges[(shortest + 1) % 3];
  const vec3 out = edges[(shortest + 2) % 3];
  return degrees_per_radian * std::atan2(norm(cross(in, out)), -dot(in, out));
}

namespace detail {

/// What the angles of a tetrahedron are made of.
struct tetrahedron_parts {
  std::array<vec3, 4> normals;           ///< of the sides, twice their areas long
  std::array<double, 6> lengths_squared; ///< of the edges, as `numbering::ridges<3>`
  double six_volumes;

  explicit tetrahedron_parts(const std::array<vec3, 4>& p) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& side = numbering::sides<3>[i];
      const vec3 a = p[side[0]];
      normals[i] = cross(p[side[1]] - a, p[side[2]] - a);
    }
    for (std::size_t r = 0; r < 6; ++r) {
      const auto& edge = numbering::ridges<3>[r];
      lengths_squared[r] = norm_squared(p[edge[1]] - p[edge[0]]);
    }
    six_volumes = std::abs(dot(normals[3], p[3] - p[0]));
  }

  /// The sine and the cosine of the angle at an edge, times the same factor. The sine comes from the volume
  /// (|n1 x n2| = 6 V |edge|), which stays accurate for slivers; it is not negative.
  std::array<double, 2> dihedral(std::size_t r) const {
    const auto& sides = numbering::sides_of_ridge<3>[r];
    return {six_volumes * std::sqrt(lengths_squared[r]), -dot(normals[sides[0]], normals[sides[1]])};
  }
};

} // namespace detail

/// Dihedral angles of a tetrahedron at its edges, in degrees, in the order of `numbering::ridges<3>`. An
/// inverted tetrahedron gives the angles of its mirror image.
inline std::array<double, 6> dihedral_angles(const std::array<vec3, 4>& p) {
  const detail::tetrahedron_parts parts(p);
  std::array<double, 6> angles;
  for (std::size_t r = 0; r < 6; ++r) {
    const auto [sine, cosine] = parts.dihedral(r);
    angles[r] = degrees_per_radian * std::atan2(sine, cosine);
  }
  return angles;
}

} // namespace dovetail
