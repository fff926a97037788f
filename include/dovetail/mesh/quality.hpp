/// @file
/// Statistics of the angles of elements, which can be merged from pieces.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace dovetail {

namespace detail {

/// The smallest and the largest dihedral angle. Six cotangents are compared, without branches, and two arc
/// tangents taken.
std::array<double, 2> extremes_of(const tetrahedron_parts& parts);

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
  void add(double degrees) { ++bins[std::clamp(static_cast<int>(degrees), 0, 179)]; }
  /// Adds the counts of another one.
  void merge(const angle_histogram& other) {
    for (std::size_t k = 0; k < bins.size(); ++k)
      bins[k] += other.bins[k];
  }
  /// How many angles lie below a whole number of degrees; exact.
  std::int64_t below(int degrees) const;
  std::int64_t total() const { return below(180); } ///< how many angles it has counted

  /// As bytes (`core/encoding.hpp`): where the bins that are not empty begin, how many there are from the
  /// first to the last, and these; a tenth of what they take in memory.
  void encode(byte_writer& to) const;
  /// Throws `input_error` for what `encode` has not written.
  static angle_histogram decode(byte_reader& from);
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
  void merge(const quality_statistics& piece, global_id first_element = 0);
};

/// Angle statistics of a mesh, D = 2 or 3; one pass.
/// Linear. Throws nothing; indices are not checked.
/// \param mesh triangles or tetrahedra; angles in the result are in degrees
template <int D>
quality_statistics measure_quality(const simplicial_mesh<D>& mesh);

#ifdef DOVETAIL_COMPILED
extern template quality_statistics measure_quality<2>(const simplicial_mesh<2>& mesh);
extern template quality_statistics measure_quality<3>(const simplicial_mesh<3>& mesh);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/quality.ipp"
#endif
