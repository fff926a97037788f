/// @file
/// Angles of elements, and statistics of them that can be merged from pieces.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

inline constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

/// Coordinates of the corners of an element.
template <std::size_t N>
std::array<vec3, N> corners(std::span<const vec3> points, const std::array<local_id, N>& vertices) {
  std::array<vec3, N> at;
  for (std::size_t k = 0; k < N; ++k)
    at[k] = points[static_cast<std::size_t>(vertices[k])];
  return at;
}

/// Angles of a triangle at its corners, in degrees.
inline std::array<double, 3> wedge_angles(const std::array<vec3, 3>& p) {
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

/// An angle of 0 to 180 degrees by its sine and cosine, both times the same factor.
struct unscaled_angle {
  double sine; ///< not negative
  double cosine;

  double degrees() const { return degrees_per_radian * std::atan2(sine, cosine); }
  /// Within 1e-3 of `degrees`, several times as fast: Abramowitz and Stegun 4.4.49. Not a number for 0, 0.
  double coarse_degrees() const {
    const double flat = std::abs(cosine);
    const double x = std::min(flat, sine) / std::max(flat, sine);
    const double square = x * x;
    const double arc =
        x * (0.9998660 +
             square * (-0.3302995 + square * (0.1801410 + square * (-0.0851330 + square * 0.0208351))));
    const double acute = degrees_per_radian * arc;
    const double turned = sine > flat ? 90.0 : 0.0; // no branches: which way they go is random
    const double upper = std::abs(turned - acute);
    const double mirrored = cosine < 0 ? 180.0 : 0.0;
    return std::abs(mirrored - upper);
  }
  bool operator<(unscaled_angle other) const {
    if (sine == 0 && other.sine == 0) // 0 or 180 degrees each
      return cosine > other.cosine;
    return sine * other.cosine < cosine * other.sine;
  }
};

/// The dihedral angles that `wedge_angles` gives.
inline std::array<unscaled_angle, 6> unscaled_wedges(const std::array<vec3, 4>& p) {
  std::array<vec3, 4> normals;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& side = numbering::sides<3>[i];
    const vec3 a = p[static_cast<std::size_t>(side[0])];
    normals[i] = cross(p[static_cast<std::size_t>(side[1])] - a, p[static_cast<std::size_t>(side[2])] - a);
  }
  const double six_volumes = std::abs(dot(normals[3], p[3] - p[0]));
  std::array<unscaled_angle, 6> angles;
  for (std::size_t r = 0; r < 6; ++r) {
    const auto& edge = numbering::ridges<3>[r];
    const auto& sides = numbering::sides_of_ridge<3>[r];
    const double length =
        distance(p[static_cast<std::size_t>(edge[0])], p[static_cast<std::size_t>(edge[1])]);
    const double cosine =
        -dot(normals[static_cast<std::size_t>(sides[0])], normals[static_cast<std::size_t>(sides[1])]);
    angles[r] = {six_volumes * length, cosine};
  }
  return angles;
}

} // namespace detail

/// Dihedral angles of a tetrahedron at its edges, in degrees, in the order of `numbering::ridges<3>`.
///
/// The sine comes from the volume (|n1 x n2| = 6 V |edge|), which stays accurate for slivers. An inverted
/// tetrahedron gives the angles of its mirror image.
inline std::array<double, 6> wedge_angles(const std::array<vec3, 4>& p) {
  std::array<double, 6> angles;
  const auto unscaled = detail::unscaled_wedges(p);
  for (std::size_t r = 0; r < 6; ++r)
    angles[r] = unscaled[r].degrees();
  return angles;
}

/// The smallest and the largest of `wedge_angles`, with two arc tangents instead of six.
inline std::array<double, 2> extreme_wedge_angles(const std::array<vec3, 4>& p) {
  const auto unscaled = detail::unscaled_wedges(p);
  const auto [smallest, largest] = std::minmax_element(unscaled.begin(), unscaled.end());
  return {smallest->degrees(), largest->degrees()};
}
inline std::array<double, 2> extreme_wedge_angles(const std::array<vec3, 3>& p) {
  const auto angles = wedge_angles(p);
  const auto [smallest, largest] = std::minmax_element(angles.begin(), angles.end());
  return {*smallest, *largest};
}

/// Counts of angles in one-degree bins: bin k holds [k, k+1), the last one 180 as well.
struct angle_histogram {
  std::array<std::int64_t, 180> bins{};

  void add(double degrees) {
    ++bins[static_cast<std::size_t>(std::clamp(static_cast<int>(degrees), 0, 179))];
  }
  void merge(const angle_histogram& other) {
    for (std::size_t k = 0; k < bins.size(); ++k)
      bins[k] += other.bins[k];
  }
  /// How many angles lie below a whole number of degrees; exact.
  std::int64_t below(int degrees) const {
    std::int64_t count = 0;
    for (int k = 0; k < std::min(degrees, 180); ++k)
      count += bins[static_cast<std::size_t>(k)];
    return count;
  }
  std::int64_t total() const { return below(180); }
};

/// Statistics of the angles of a mesh. Those of pieces merge into those of the whole.
///
/// Wedge angles are dihedral angles (D = 3) or corner angles (D = 2); face angles are the corner angles of an
/// element's triangles, which for D = 2 are the same.
struct quality_statistics {
  std::int64_t elements = 0;
  double min_wedge_deg = 180; ///< 180 for an empty mesh
  double max_wedge_deg = 0;
  double min_face_deg = 180;
  double sum_of_min_wedge_deg = 0; ///< over elements; see mean_min_wedge_deg
  global_id worst_element = -1;    ///< the element with the smallest wedge angle; the first of several
  angle_histogram min_wedges;      ///< each element's smallest wedge angle
  angle_histogram max_wedges;      ///< each element's largest wedge angle
  angle_histogram face_angles;     ///< all face angles

  /// Elements with a wedge angle under 6, 12, 18 and 24 degrees.
  std::array<std::int64_t, 4> under_6_12_18_24() const {
    return {min_wedges.below(6), min_wedges.below(12), min_wedges.below(18), min_wedges.below(24)};
  }
  double mean_min_wedge_deg() const {
    return elements == 0 ? 0 : sum_of_min_wedge_deg / static_cast<double>(elements);
  }
  double per_million_under(int degrees) const {
    return elements == 0
               ? 0
               : 1e6 * static_cast<double>(min_wedges.below(degrees)) / static_cast<double>(elements);
  }

  /// Adds the statistics of a piece whose element 0 has the number `first_element` in the whole.
  void merge(const quality_statistics& piece, global_id first_element = 0) {
    if (piece.elements > 0 && piece.min_wedge_deg < min_wedge_deg) {
      min_wedge_deg = piece.min_wedge_deg;
      worst_element = first_element + piece.worst_element;
    }
    elements += piece.elements;
    max_wedge_deg = std::max(max_wedge_deg, piece.max_wedge_deg);
    min_face_deg = std::min(min_face_deg, piece.min_face_deg);
    sum_of_min_wedge_deg += piece.sum_of_min_wedge_deg;
    min_wedges.merge(piece.min_wedges);
    max_wedges.merge(piece.max_wedges);
    face_angles.merge(piece.face_angles);
  }
};

namespace detail {

/// Twelve of these per tetrahedron: arc tangents are taken only where the bin or the smallest depends on
/// them.
inline void add_face_angle(quality_statistics& statistics, unscaled_angle angle) {
  constexpr double error = 2e-3; // twice that of the coarse angle
  const double coarse = angle.coarse_degrees();
  if (coarse > statistics.min_face_deg + error) { // not when it is not a number
    const double in_bin = coarse - static_cast<int>(coarse);
    if (in_bin > error && in_bin < 1 - error) {
      statistics.face_angles.add(coarse);
      return;
    }
  }
  const double degrees = angle.degrees();
  statistics.face_angles.add(degrees);
  statistics.min_face_deg = std::min(statistics.min_face_deg, degrees);
}

inline void add_face_angles(quality_statistics& statistics, const std::array<vec3, 3>& p) {
  const vec3 ab = p[1] - p[0];
  const vec3 bc = p[2] - p[1];
  const vec3 ca = p[0] - p[2];
  const double twice_area = norm(cross(ab, bc));
  add_face_angle(statistics, {twice_area, -dot(ca, ab)});
  add_face_angle(statistics, {twice_area, -dot(ab, bc)});
  add_face_angle(statistics, {twice_area, -dot(bc, ca)});
}

} // namespace detail

/// Angle statistics of a mesh, D = 2 or 3; one pass.
template <int D>
quality_statistics measure_quality(const simplicial_mesh<D>& mesh) {
  quality_statistics statistics;
  statistics.elements = static_cast<std::int64_t>(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto at = corners(std::span(mesh.points), mesh.elements[e]);
    const auto [smallest, largest] = extreme_wedge_angles(at);
    if (smallest < statistics.min_wedge_deg || e == 0) {
      statistics.min_wedge_deg = smallest;
      statistics.worst_element = static_cast<global_id>(e);
    }
    statistics.max_wedge_deg = std::max(statistics.max_wedge_deg, largest);
    statistics.sum_of_min_wedge_deg += smallest;
    statistics.min_wedges.add(smallest);
    statistics.max_wedges.add(largest);
    if constexpr (D == 2) {
      detail::add_face_angles(statistics, at);
    } else {
      for (const auto& side : numbering::sides<D>)
        detail::add_face_angles(statistics,
                                {at[static_cast<std::size_t>(side[0])], at[static_cast<std::size_t>(side[1])],
                                 at[static_cast<std::size_t>(side[2])]});
    }
  }
  return statistics;
}

} // namespace dovetail
