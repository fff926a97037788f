/// @file
/// What interface angles a rule wants: by these, and no numbers of their own, the stages after the
/// simplification match segments, move interfaces and count what is too small.
#pragma once

#include "dovetail/mesh/wanted_angles.hpp"
#include "dovetail/simplification/concepts.hpp"
#include "dovetail/simplification/paper.hpp"

#include <concepts>

namespace dovetail {

namespace detail {

template <class Rule>
inline constexpr bool says_what_it_wants = requires(const Rule& rule) {
  { rule.wants(3) } -> std::same_as<wanted_angles>;
};

} // namespace detail

/// What the rule says by `wants(D)`. A rule without that function wants of dihedrals what its judgement says,
/// which for this is asked about a mesh without elements. An angle that a rule has no opinion about (0) is
/// the one of the paper.
/// Constant time. Throws what the rule throws.
/// \param rule such as `simplifier::paper`
template <int D, simplification_rule<D> Rule>
wanted_angles wanted_angles_of(const Rule& rule) {
  wanted_angles wanted;
  if constexpr (detail::says_what_it_wants<Rule>)
    wanted = rule.wants(D);
  else
    wanted.dihedral_deg = rule(simplicial_mesh<D>{}, side_table<D>{}).wanted_angle_deg;
  const wanted_angles of_paper = simplifier::paper{}.wants(D);
  return {wanted.face_deg > 0 ? wanted.face_deg : of_paper.face_deg,
          wanted.dihedral_deg > 0 ? wanted.dihedral_deg : of_paper.dihedral_deg};
}

} // namespace dovetail
