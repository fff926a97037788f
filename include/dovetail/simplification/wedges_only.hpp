/// @file
/// The paper's rule without its analysis of shapes.
#pragma once

#include "dovetail/simplification/paper.hpp"

namespace dovetail::simplifier {

/// Of small wedges one side goes, however good it is by itself. Angles in degrees.
struct wedges_only {
  double surface_deg = 50; ///< smaller corners between lines of the surface are removed
  double volume_deg = 30;  ///< smaller dihedral angles between faces are removed
  refusal_price price_of_refusal = {};

  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    return {side_shapes(mesh, sides), 0, D == 2 ? surface_deg : volume_deg};
  }
  bool first_goes(const wedge_side& a, const wedge_side& b) const { return is_worse(a, b); }
  std::optional<ridge_decision> couples(const side_below& below) const {
    return as_below(below, surface_deg);
  }
  double price(const shortfall& missed) const { return price_of_refusal(missed); }
};
static_assert(simplification_rule<wedges_only, 2> && simplification_rule<wedges_only, 3>);

} // namespace dovetail::simplifier
