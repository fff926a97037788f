/// @file
/// What is the same wherever interface angles are measured.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/angle_types.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/wanted_angles.hpp"

#include <array>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::detail {

inline void sort_violations(std::vector<angle_violation>& violations) {
  sort_all(violations, [](const angle_violation& a, const angle_violation& b) {
    return std::tuple(a.angle_deg, a.sides, a.edge) < std::tuple(b.angle_deg, b.sides, b.edge);
  });
}

/// The least angles and the list of those that are too small.
class angle_collector {
public:
  explicit angle_collector(const wanted_angles& wanted) : wanted_(wanted) {}

  /// A triangle on an interface.
  void add_face(local_id side, const std::array<vec3, 3>& p, violation_cause cause) {
    const double angle = smallest_corner_angle(p);
    const least_angle here{angle, {side, no_id}, {no_id, no_id}};
    if (angle < found.face_angle.angle_deg)
      found.face_angle = here;
    if (angle < wanted_.face_deg - rounding_deg)
      found.violations.push_back({angle, cause, here.sides, here.edge, no_id, (p[0] + p[1] + p[2]) / 3.0});
  }
  /// Returns whether the dihedral is too small, and so the last of the violations.
  bool add_dihedral(const least_angle& here, bool at_surface, violation_cause cause, local_id subdomain,
                    vec3 place) {
    least_angle& minimum = at_surface ? found.surface_dihedral : found.interface_dihedral;
    if (here.angle_deg < minimum.angle_deg)
      minimum = here;
    if (!is_small_dihedral(here.angle_deg))
      return false;
    found.violations.push_back({here.angle_deg, cause, here.sides, here.edge, subdomain, place});
    return true;
  }
  bool is_small_dihedral(double angle) const { return angle < wanted_.dihedral_deg - rounding_deg; }

  interface_angles take() {
    sort_violations(found.violations);
    return std::move(found);
  }

  interface_angles found;

private:
  /// The same angle comes out differently when another sum of angles, or none, leads to it.
  static constexpr double rounding_deg = 1e-6;

  wanted_angles wanted_;
};

} // namespace dovetail::detail
