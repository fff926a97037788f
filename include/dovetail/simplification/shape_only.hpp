/// @file
/// The paper's rule without the deletion of small wedges.
#pragma once

#include "dovetail/simplification/paper.hpp"

namespace dovetail::simplifier {

/// Sides with a small angle of their own go, whatever they include with others. Angles in degrees.
struct shape_only {
  double surface_deg = 0; ///< edges that bound a smaller corner of a triangle are removed; 0: none
  double volume_deg = 30; ///< faces with a smaller corner are removed
  refusal_price price_of_refusal = {};

  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    return {side_shapes(mesh, sides), D == 2 ? surface_deg : volume_deg};
  }
  wanted_angles wants(int dimension) const { return {dimension == 2 ? surface_deg : volume_deg, 0}; }
  bool first_goes(const wedge_side& a, const wedge_side& b) const { return is_worse(a, b); }
  std::optional<ridge_decision> couples(const side_below& below) const {
    return as_below(below, surface_deg);
  }
  double price(const shortfall& missed) const { return price_of_refusal(missed); }
};
static_assert(simplification_rule<shape_only, 2> && simplification_rule<shape_only, 3>);

} // namespace dovetail::simplifier
