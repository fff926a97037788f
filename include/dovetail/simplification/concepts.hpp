/// @file
/// What the simplification asks of a rule.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/mesh/side_table.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <concepts>
#include <optional>
#include <vector>

namespace dovetail {

/// How good something is, and how good it would have to be. Neither is negative.
struct deficit {
  double value = 0;  ///< what it has
  double wanted = 0; ///< what it would have to have

  /// The part of what is wanted that is there; smaller is worse, in whatever unit.
  double fraction() const { return value / wanted; }
};

/// What a rule says about the sides and dihedrals of one mesh, or the edges of one graph.
struct side_judgement {
  std::vector<double> quality =
      {};                      ///< of each side as an interface, not negative, in a unit of the rule's own
  double wanted_quality = 0;   ///< sides below it are candidates; 0: none are
  double wanted_angle_deg = 0; ///< dihedrals below it are too small; 0: none are
};

/// One of the two sides of a dihedral that is too small.
struct dihedral_side {
  local_id side = no_id; ///< the number of the side
  double quality = 0;    ///< by itself; less is worse
  double weight = 0;     ///< of the super-element that arises when the side is removed
};

/// A side of the mesh one dimension below, removed or refused there. It is a ridge of this mesh.
struct side_below {
  side_state state = side_state::kept; ///< what was decided about it
  double quality = 0;                  ///< by itself; less is worse
  deficit missed;                      ///< of a refused side: why it ought to have been removed
};

/// What becomes of the sides at a ridge.
struct ridge_decision {
  deficit missed;             ///< what the dihedral at the ridge falls short of
  bool only_penalise = false; ///< false: they are removed; true: they stay, penalised like refused ones
};

/// What the contraction of dual graphs asks while it runs.
///
/// Valid expressions for `const R& r`, `const dihedral_side& a` and `b`, `const deficit& d`:
///
/// - `r.prefer_removal(a, b)`: bool: of the two sides of a dihedral that is too small, neither of them fixed,
///   a is removed rather than b
/// - `r.penalty(d)`: double: how many times its own weight a refused side weighs in the contracted graph
///
/// Semantics: both are pure functions; `prefer_removal(a, b) != prefer_removal(b, a)` for different sides.
/// The penalty is positive.
///
/// Complexity: constant.
///
/// Failure: none.
///
/// Models: every simplification_rule.
template <class R>
concept contraction_rule = requires(const R& r, const dihedral_side& a, const dihedral_side& b,
                                    const deficit& d) {
  { r.prefer_removal(a, b) } -> std::same_as<bool>;
  { r.penalty(d) } -> std::convertible_to<double>;
};

/// The role `simplification_rule` (`simplification_rule<R, D>`): which sides of a coarse mesh may not become
/// interfaces.
///
/// Valid expressions, beside those of `contraction_rule`, for `const R& r`, `const simplicial_mesh<D>& mesh`,
/// `const side_table<D>& sides`, `const side_below& below`:
///
/// - `r(mesh, sides)`: side_judgement: which sides are candidates, and which dihedrals are too small
/// - `r.propagate(below)`: std::optional<ridge_decision>: what a removed or refused side of the surface means
///   for the interior sides of the volume at it; nothing for nothing
/// - optional: `r.wants(D)`: wanted_angles: the interface angles below which later stages mend and count
///   interfaces (`wanted_angles_of`); of dihedrals the same as in the judgement. Without it: what the
///   judgement of a mesh without elements says
///
/// Semantics: `sides` is `build_sides(mesh)`, and the judgement has one quality per side, those of fixed
/// sides unused. Removed are first the sides at coupled ridges, then candidates, worst first, then one of the
/// two sides of each dihedral that is too small, smallest first; dihedrals are measured across removed sides.
/// A removal that would make a super-element too heavy is refused. All calls are pure functions.
///
/// Complexity: linear in the mesh.
///
/// Failure: throws `usage_error` when its members make no sense.
///
/// Models: simplifier::paper, none, shape_only, dihedrals_only, aspect_ratio, flow_aligned;
/// any_simplification_rule.
template <class R, int D>
concept simplification_rule = contraction_rule<R> && std::copy_constructible<R> &&
    requires(const R& r, const simplicial_mesh<D>& mesh, const side_table<D>& sides,
             const side_below& below) {
  { r(mesh, sides) } -> std::same_as<side_judgement>;
  { r.propagate(below) } -> std::same_as<std::optional<ridge_decision>>;
};

} // namespace dovetail
