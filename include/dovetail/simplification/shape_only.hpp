/// @file
/// The paper's rule without the deletion of small dihedrals.
#pragma once

#include "dovetail/mesh/wanted_angles.hpp"
#include "dovetail/simplification/rule_parts.hpp"
#include "dovetail/simplification/side_shape.hpp"

#include <optional>

namespace dovetail::simplifier {

/// Sides with a small angle of their own go, whatever they include with others. Angles in degrees.
struct shape_only {
  double surface_deg = 0; ///< edges that bound a smaller corner of a triangle are removed; 0: none
  double volume_deg = 30; ///< faces with a smaller corner are removed
  refusal_penalty penalty_of_refusal = {}; ///< of sides that the bound refuses to remove

  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    return {side_shapes(mesh, sides), D == 2 ? surface_deg : volume_deg};
  }
  wanted_angles wants(int dimension) const { return {dimension == 2 ? surface_deg : volume_deg, 0}; }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return is_worse(a, b); }
  std::optional<ridge_decision> propagate(const side_below& below) const {
    return as_below(below, surface_deg);
  }
  double penalty(const deficit& missed) const { return penalty_of_refusal(missed); }
};
static_assert(simplification_rule<shape_only, 2> && simplification_rule<shape_only, 3>);

} // namespace dovetail::simplifier
