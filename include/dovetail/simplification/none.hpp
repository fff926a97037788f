/// @file
/// The rule that removes nothing, for a plain partition.
#pragma once

#include "dovetail/simplification/concepts.hpp"

#include <optional>

namespace dovetail::simplifier {

/// A plain partition of the coarse mesh, for comparison.
struct none {
  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& /*mesh*/, const side_table<D>& sides) const {
    return {std::vector<double>(sides.size(), 0.0)};
  }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return a.side < b.side; }
  std::optional<ridge_decision> propagate(const side_below& /*below*/) const { return {}; }
  double penalty(const deficit& /*missed*/) const { return 1; }
};
static_assert(simplification_rule<none, 2> && simplification_rule<none, 3>);

} // namespace dovetail::simplifier
