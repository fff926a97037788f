/// @file
/// Which elements cannot be good because of the fixed sides they touch, and quality counts of both classes.
#pragma once

#include "dovetail/improver/quality_counts.hpp"
#include "dovetail/improver/tetrahedra/tet_complex.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dovetail::improvement {

/// A fixed triangle with a smaller angle limits the elements at its vertices.
inline constexpr double limiting_triangle_angle = 20;
/// Two fixed sides that meet at a smaller angle inside the mesh limit the elements at their common edge.
inline constexpr double limiting_dihedral_angle = 48;

/// cos of the dihedral angle of element (a, b, c, d) at its edge (a, b).
inline double cos_of_dihedral(vec3 a, vec3 b, vec3 c, vec3 d) {
  const vec3 n = cross(b - a, c - a), m = cross(b - a, d - a);
  const double lengths = std::sqrt(norm_squared(n) * norm_squared(m));
  return lengths > 0 ? std::clamp(dot(n, m) / lengths, -1.0, 1.0) : 1.0;
}

/// Marks the vertices of fixed triangles and dihedrals that are sharper than the limits. O(fixed sides).
class surface_limits {
public:
  explicit surface_limits(const tet_complex& mesh);
  /// The element touches a vertex of a sharp fixed triangle or dihedral.
  bool limits(const simplex<3>& element) const {
    return std::any_of(element.begin(), element.end(), [&](local_id v) {
      return static_cast<std::size_t>(v) < is_limiting_.size() && is_limiting_[v] != 0;
    });
  }

private:
  void examine(const tet_complex& mesh, local_id e, int side);

  /// Turns around the edge (a, b) from a fixed side to the next one.
  static bool dihedral_is_sharp(const tet_complex& mesh, local_id e, int side, local_id a, local_id b);
  void limit(local_id v) { is_limiting_[v] = 1; }

  std::vector<std::uint8_t> is_limiting_;
};

/// The smallest and largest cosine of an element's dihedral angles, and six times its signed volume.
struct dihedral_cosines {
  double least, most, six_volumes; ///< the smallest and the largest cosine, and six times the volume
};
/// The cosines and the volume of the element (p, q, r, s).
dihedral_cosines dihedral_cosines_of(vec3 p, vec3 q, vec3 r, vec3 s);

/// O(elements).
quality_counts count_quality(const tet_complex& mesh, const surface_limits& limits);

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/tetrahedra/surface_limits.ipp"
#endif
