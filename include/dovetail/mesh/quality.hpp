/// @file
/// Statistics of the angles of elements, which can be merged from pieces.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

namespace detail {

/// The smallest and the largest dihedral angle. Six cotangents are compared, without branches, and two arc
/// tangents taken.
inline std::array<double, 2> extremes_of(const tetrahedron_parts& parts) {
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

/// The smallest and the largest of `dihedral_angles`, but for rounding.
inline std::array<double, 2> extreme_dihedral_angles(const std::array<vec3, 4>& p) {
  return detail::extremes_of(detail::tetrahedron_parts(p));
}
inline std::array<double, 2> extreme_dihedral_angles(const std::array<vec3, 3>& p) {
  const auto angles = dihedral_angles(p);
  const auto [smallest, largest] = std::minmax_element(angles.begin(), angles.end());
  return {*smallest, *largest};
}

/// Counts of angles in one-degree bins: bin k holds [k, k+1), the last one 180 as well.
struct angle_histogram {
  std::array<std::int64_t, 180> bins{}; ///< how many angles fall into each degree

  /// Counts an angle; what is outside [0, 180] goes to the nearest bin.
  void add(double degrees) {
    ++bins[static_cast<std::size_t>(std::clamp(static_cast<int>(degrees), 0, 179))];
  }
  /// Adds the counts of another one.
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
  std::int64_t total() const { return below(180); } ///< how many angles it has counted

  /// As bytes (`core/encoding.hpp`): where the bins that are not empty begin, how many there are from the
  /// first to the last, and these; a tenth of what they take in memory.
  void encode(byte_writer& to) const {
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
  /// Throws `input_error` for what `encode` has not written.
  static angle_histogram decode(byte_reader& from) {
    angle_histogram histogram;
    const std::uint64_t first = from.count(), count = from.count();
    if (first > histogram.bins.size() || count > histogram.bins.size() - first)
      throw input_error("binary data have more than 180 degrees");
    for (std::uint64_t k = first; k < first + count; ++k)
      histogram.bins[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(from.count());
    return histogram;
  }
};

/// Statistics of the angles of a mesh. Those of pieces merge into those of the whole.
///
/// Dihedrals are dihedral angles (D = 3) or corner angles (D = 2); face angles are the corner angles of an
/// element's triangles, which for D = 2 are the same.
struct quality_statistics {
  std::int64_t elements = 0;          ///< how many were measured
  double min_dihedral_deg = 180;      ///< 180 for an empty mesh
  double max_dihedral_deg = 0;        ///< the largest of all
  double min_face_deg = 180;          ///< the smallest of all
  double sum_of_min_dihedral_deg = 0; ///< over elements; see mean_min_dihedral_deg
  global_id worst_element = -1;       ///< the element with the smallest dihedral angle; the first of several
  angle_histogram min_dihedrals;      ///< each element's smallest dihedral angle
  angle_histogram max_dihedrals;      ///< each element's largest dihedral angle

  using fields = field_list<&quality_statistics::elements, &quality_statistics::min_dihedral_deg,
                            &quality_statistics::max_dihedral_deg, &quality_statistics::min_face_deg,
                            &quality_statistics::sum_of_min_dihedral_deg, &quality_statistics::worst_element,
                            &quality_statistics::min_dihedrals, &quality_statistics::max_dihedrals>;

  /// Elements with a dihedral angle under 6, 12, 18 and 24 degrees.
  std::array<std::int64_t, 4> under_6_12_18_24() const {
    return {min_dihedrals.below(6), min_dihedrals.below(12), min_dihedrals.below(18),
            min_dihedrals.below(24)};
  }
  /// The mean over the elements of their smallest dihedral angle; 0 without elements.
  double mean_min_dihedral_deg() const {
    return elements == 0 ? 0 : sum_of_min_dihedral_deg / static_cast<double>(elements);
  }
  /// Elements per million whose smallest dihedral angle is below that.
  double per_million_under(int degrees) const {
    return elements == 0
               ? 0
               : 1e6 * static_cast<double>(min_dihedrals.below(degrees)) / static_cast<double>(elements);
  }

  /// Adds the statistics of a piece whose element 0 has the number `first_element` in the whole.
  void merge(const quality_statistics& piece, global_id first_element = 0) {
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
};

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
      include({p[static_cast<std::size_t>(side[0])], p[static_cast<std::size_t>(side[1])],
               p[static_cast<std::size_t>(side[2])]},
              norm_squared(parts.normals[i]), parts.lengths_squared[edges[0]],
              parts.lengths_squared[edges[1]], parts.lengths_squared[edges[2]]);
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

} // namespace detail

/// Angle statistics of a mesh, D = 2 or 3; one pass.
template <int D>
quality_statistics measure_quality(const simplicial_mesh<D>& mesh) {
  quality_statistics statistics;
  statistics.elements = static_cast<std::int64_t>(mesh.elements.size());
  detail::smallest_face_angle face_angle;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto at = corners(span_of(mesh.points), mesh.elements[e]);
    std::array<double, 2> extremes;
    if constexpr (D == 2) {
      extremes = extreme_dihedral_angles(at);
      face_angle.include(at);
    } else {
      const detail::tetrahedron_parts parts(at);
      extremes = detail::extremes_of(parts);
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
  }
  statistics.min_face_deg = face_angle.degrees();
  return statistics;
}

} // namespace dovetail
