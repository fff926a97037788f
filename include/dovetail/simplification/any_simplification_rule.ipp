/// @file
/// What `any_simplification_rule.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "dovetail/simplification/concepts.hpp"

#include <optional>

namespace dovetail {

DOVETAIL_INLINE side_judgement any_simplification_rule::operator()(const simplicial_mesh<2>& mesh,
                                                                   const side_table<2>& sides) const {
  return asked([&] { return held_->judge(mesh, sides); });
}

DOVETAIL_INLINE side_judgement any_simplification_rule::operator()(const simplicial_mesh<3>& mesh,
                                                                   const side_table<3>& sides) const {
  return asked([&] { return held_->judge(mesh, sides); });
}

DOVETAIL_INLINE bool any_simplification_rule::prefer_removal(const dihedral_side& a,
                                                             const dihedral_side& b) const {
  return asked([&] { return held_->prefer_removal(a, b); });
}

DOVETAIL_INLINE std::optional<ridge_decision>
any_simplification_rule::propagate(const side_below& below) const {
  return asked([&] { return held_->propagate(below); });
}

DOVETAIL_INLINE double any_simplification_rule::penalty(const deficit& missed) const {
  return asked([&] { return held_->penalty(missed); });
}

DOVETAIL_INLINE wanted_angles any_simplification_rule::wants(int dimension) const {
  return asked([&] { return held_->wants(dimension); });
}

} // namespace dovetail
