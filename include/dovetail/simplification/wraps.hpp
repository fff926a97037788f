/// @file
/// A simplification rule around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/mesh/wanted_angles.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"
#include "dovetail/simplification/concepts.hpp"

#include <optional>

namespace dovetail {

namespace simplifier {

/// Base of a rule that changes a part of what another one decides; the rest, and the angles that are wanted,
/// are those of `Rule`.
template <class Self, class Rule>
struct wraps : wrapped_policy<Self, Rule> {
  static_assert(simplification_rule<Rule, 2> || simplification_rule<Rule, 3>,
                "simplifier::wraps holds a simplification_rule (simplification/concepts.hpp)");
  using wrapped_policy<Self, Rule>::wrapped_policy;
  using wrapped_policy<Self, Rule>::wrapped;

  /// Which of two sides goes, by the wrapped rule.
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const {
    return wrapped.prefer_removal(a, b);
  }
  /// The weight of a refused side, by the wrapped rule.
  double penalty(const deficit& d) const { return wrapped.penalty(d); }
  /// The judgement of the wrapped rule.
  template <int D>
    requires(simplification_rule<Rule, D>)
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    return wrapped(mesh, sides);
  }
  /// What the surface means for the volume, by the wrapped rule.
  std::optional<ridge_decision> propagate(const side_below& below) const { return wrapped.propagate(below); }
  /// The angles that the wrapped rule wants.
  wanted_angles wants(int dimension) const requires detail::says_what_it_wants<Rule> {
    return wrapped.wants(dimension);
  }
};

} // namespace simplifier
} // namespace dovetail
