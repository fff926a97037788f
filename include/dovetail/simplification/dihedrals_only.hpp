/// @file
/// The paper's rule without its analysis of shapes.
#pragma once

#include "dovetail/simplification/rule_parts.hpp"
#include "dovetail/simplification/side_shape.hpp"

#include <optional>

namespace dovetail::simplifier {

/// Of small dihedrals one side goes, however good it is by itself. Angles in degrees.
struct dihedrals_only {
  double surface_dihedral_deg = 50;        ///< smaller corners between lines of the surface are removed
  double volume_dihedral_deg = 30;         ///< smaller dihedral angles between faces are removed
  refusal_penalty penalty_of_refusal = {}; ///< of sides that the bound refuses to remove

  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    return {side_shapes(mesh, sides), 0, D == 2 ? surface_dihedral_deg : volume_dihedral_deg};
  }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return is_worse(a, b); }
  std::optional<ridge_decision> propagate(const side_below& below) const {
    return as_below(below, surface_dihedral_deg);
  }
  double penalty(const deficit& missed) const { return penalty_of_refusal(missed); }
};
static_assert(simplification_rule<dihedrals_only, 2> && simplification_rule<dihedrals_only, 3>);

} // namespace dovetail::simplifier
