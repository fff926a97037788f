/// @file
/// A rule that judges interfaces by the aspect ratio of triangles in place of their angles; of small
/// dihedrals the side of worse ratio goes.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/simplification/rule_parts.hpp"

#include <array>
#include <cmath>
#include <optional>

namespace dovetail::simplifier {

/// Faces of bad aspect ratio go, in D = 2 edges beside a triangle of bad aspect ratio; of small dihedrals, as
/// in the paper's rule, one side goes, but the one of worse ratio. The ratio is twice the inscribed over the
/// circumscribed circle's radius: 1 for an equilateral triangle, 0.46 for one with two angles of 30 degrees.
struct aspect_ratio {
  double surface_ratio = 0;         ///< edges beside worse triangles are removed; 0: none
  double volume_ratio = 0.46;       ///< worse faces are removed; 0: none
  double surface_dihedral_deg = 50; ///< smaller corners between lines of the surface are removed; 0: none
  double volume_dihedral_deg = 30;  ///< smaller dihedral angles between faces are removed; 0: none
  refusal_penalty penalty_of_refusal = {}; ///< of sides that the bound refuses to remove

  side_judgement operator()(const simplicial_mesh<3>& mesh, const side_table<3>& sides) const;
  side_judgement operator()(const simplicial_mesh<2>& mesh, const side_table<2>& sides) const;
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return is_worse(a, b); }
  std::optional<ridge_decision> propagate(const side_below& below) const { return as_below(below, 1); }
  double penalty(const deficit& missed) const { return penalty_of_refusal(missed); }

  /// Twice the radius of the inscribed circle over that of the circumscribed one; 0 for a degenerate
  /// triangle.
  static double ratio(const std::array<vec3, 3>& p);
};
static_assert(simplification_rule<aspect_ratio, 2> && simplification_rule<aspect_ratio, 3>);

} // namespace dovetail::simplifier

#ifndef DOVETAIL_COMPILED
#include "dovetail/simplification/aspect_ratio.ipp"
#endif
