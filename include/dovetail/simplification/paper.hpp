/// @file
/// The rule of the paper: faces with a corner under 30 degrees go, and of two faces that include less than 30
/// degrees (lines on the surface: 50) the worse.
#pragma once

#include "dovetail/mesh/wanted_angles.hpp"
#include "dovetail/simplification/rule_parts.hpp"
#include "dovetail/simplification/side_shape.hpp"

#include <optional>

namespace dovetail::simplifier {

/// J. Chen et al. (2018), Section 3.3: no interface has a small angle of its own, and no two include one with
/// each other or with the surface. Angles in degrees; 0 switches one off.
struct paper {
  double surface_dihedral_deg = 50;        ///< smaller corners between lines of the surface are removed
  double volume_dihedral_deg = 30;         ///< smaller dihedral angles between faces are removed
  double surface_shape_deg = 0;            ///< edges that bound a smaller corner of a triangle are removed
  double volume_shape_deg = 30;            ///< faces with a smaller corner are removed
  refusal_penalty penalty_of_refusal = {}; ///< of sides that the bound refuses to remove

  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    return {side_shapes(mesh, sides), D == 2 ? surface_shape_deg : volume_shape_deg,
            D == 2 ? surface_dihedral_deg : volume_dihedral_deg};
  }
  wanted_angles wants(int dimension) const {
    return dimension == 2 ? wanted_angles{surface_shape_deg, surface_dihedral_deg}
                          : wanted_angles{volume_shape_deg, volume_dihedral_deg};
  }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return is_worse(a, b); }
  std::optional<ridge_decision> propagate(const side_below& below) const {
    return as_below(below, surface_dihedral_deg);
  }
  double penalty(const deficit& missed) const { return penalty_of_refusal(missed); }
};
static_assert(simplification_rule<paper, 2> && simplification_rule<paper, 3>);

} // namespace dovetail::simplifier
