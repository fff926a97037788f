/// @file
/// What `quality.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace dovetail {

namespace detail {

DOVETAIL_INLINE std::array<double, 2> extremes_of(const tetrahedron_parts& parts) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double largest_cotangent = -infinity, smallest_cotangent = infinity;
  for (std::size_t r = 0; r < 6; ++r) {
    const auto [sine, cosine] = parts.dihedral(r);
    const double cotangent = sine > 0 ? cosine / sine : cosine < 0 ? -infinity : infinity;
    largest_cotangent = std::max(largest_cotangent, cotangent);
    smallest_cotangent = std::min(smallest_cotangent, cotangent);
  }
  return {degrees_per_radian * std::atan2(1.0, largest_cotangent),
          degrees_per_radian * std::atan2(1.0, smallest_cotangent)};
}

} // namespace detail

DOVETAIL_INLINE std::int64_t angle_histogram::below(int degrees) const {
  std::int64_t count = 0;
  for (int k = 0; k < std::min(degrees, 180); ++k)
    count += bins[k];
  return count;
}

DOVETAIL_INLINE void angle_histogram::encode(byte_writer& to) const {
  std::size_t first = 0, end = bins.size();
  while (end > 0 && bins[end - 1] == 0)
    --end;
  while (first < end && bins[first] == 0)
    ++first;
  to.count(first);
  to.count(end - first);
  for (std::size_t k = first; k < end; ++k)
    to.count(static_cast<std::uint64_t>(bins[k]));
}

DOVETAIL_INLINE angle_histogram angle_histogram::decode(byte_reader& from) {
  angle_histogram histogram;
  const std::uint64_t first = from.count(), count = from.count();
  if (first > histogram.bins.size() || count > histogram.bins.size() - first)
    throw input_error("binary data have more than 180 degrees");
  for (std::uint64_t k = first; k < first + count; ++k)
    histogram.bins[k] = static_cast<std::int64_t>(from.count());
  return histogram;
}

DOVETAIL_INLINE void quality_statistics::merge(const quality_statistics& piece, global_id first_element) {
  if (piece.elements > 0 && piece.min_dihedral_deg < min_dihedral_deg) {
    min_dihedral_deg = piece.min_dihedral_deg;
    worst_element = first_element + piece.worst_element;
  }
  elements += piece.elements;
  max_dihedral_deg = std::max(max_dihedral_deg, piece.max_dihedral_deg);
  min_face_deg = std::min(min_face_deg, piece.min_face_deg);
  sum_of_min_dihedral_deg += piece.sum_of_min_dihedral_deg;
  min_dihedrals.merge(piece.min_dihedrals);
  max_dihedrals.merge(piece.max_dihedrals);
}

namespace detail {

/// The smallest corner angle of triangles that come one by one. They are compared by the squares of their
/// sines; arc tangents are taken only where one may be the smallest so far.
class smallest_face_angle {
public:
  double degrees() const { return degrees_; }

  /// A triangle, twice its area and its edges, squared. The smallest angle is opposite the shortest edge, and
  /// at most 60 degrees, so that it grows with its sine.
  void include(const std::array<vec3, 3>& p, double twice_area_squared, double a, double b, double c) {
    const double by_sine = twice_area_squared * std::min({a, b, c});
    constexpr double rounding = 1 + 1e-9;
    if (by_sine > rounding * sine_squared_ * (a * b * c))
      return;
    const auto angles = dihedral_angles(p);
    degrees_ = std::min({degrees_, angles[0], angles[1], angles[2]});
    if (a * b * c > 0)
      sine_squared_ = std::min(sine_squared_, by_sine / (a * b * c));
  }
  void include(const std::array<vec3, 3>& p) {
    const vec3 ab = p[1] - p[0], bc = p[2] - p[1], ca = p[0] - p[2];
    include(p, norm_squared(cross(ab, bc)), norm_squared(ab), norm_squared(bc), norm_squared(ca));
  }
  void include(const std::array<vec3, 4>& p, const tetrahedron_parts& parts) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& side = numbering::sides<3>[i];
      const auto& edges = edges_of_sides[i];
      include({p[side[0]], p[side[1]], p[side[2]]}, norm_squared(parts.normals[i]),
              parts.lengths_squared[edges[0]], parts.lengths_squared[edges[1]],
              parts.lengths_squared[edges[2]]);
    }
  }

private:
  /// Per side the three edges on it, as `numbering::ridges<3>`.
  static constexpr auto edges_of_sides = [] {
    std::array<std::array<std::size_t, 3>, 4> edges{};
    std::array<std::size_t, 4> found{};
    for (std::size_t r = 0; r < 6; ++r)
      for (const int side : numbering::sides_of_ridge<3>[r]) {
        const auto i = static_cast<std::size_t>(side);
        edges[i][found[i]++] = r;
      }
    return edges;
  }();

  double degrees_ = 180;
  double sine_squared_ = 1;
};

/// Measures all elements, and calls `use(element, smallest_angle)` for each.
template <int D, class Use>
quality_statistics measure_each(const simplicial_mesh<D>& mesh, const Use& use) {
  quality_statistics statistics;
  statistics.elements = static_cast<std::int64_t>(mesh.elements.size());
  smallest_face_angle face_angle;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto at = corners(span_of(mesh.points), mesh.elements[e]);
    std::array<double, 2> extremes;
    if constexpr (D == 2) {
      extremes = extreme_dihedral_angles(at);
      face_angle.include(at);
    } else {
      const tetrahedron_parts parts(at);
      extremes = extremes_of(parts);
      face_angle.include(at, parts);
    }
    const auto [smallest, largest] = extremes;
    if (smallest < statistics.min_dihedral_deg || e == 0) {
      statistics.min_dihedral_deg = smallest;
      statistics.worst_element = static_cast<global_id>(e);
    }
    statistics.max_dihedral_deg = std::max(statistics.max_dihedral_deg, largest);
    statistics.sum_of_min_dihedral_deg += smallest;
    statistics.min_dihedrals.add(smallest);
    statistics.max_dihedrals.add(largest);
    use(e, smallest);
  }
  statistics.min_face_deg = face_angle.degrees();
  return statistics;
}

} // namespace detail

template <int D>
quality_statistics measure_quality(const simplicial_mesh<D>& mesh) {
  return detail::measure_each(mesh, [](std::size_t, double) {});
}

#ifdef DOVETAIL_COMPILED
template quality_statistics measure_quality<2>(const simplicial_mesh<2>& mesh);
template quality_statistics measure_quality<3>(const simplicial_mesh<3>& mesh);
#endif

} // namespace dovetail
