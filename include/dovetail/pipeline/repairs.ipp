/// @file
/// What `repairs.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/pipeline/repairs.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

namespace dovetail {

DOVETAIL_INLINE void apply(const repair& wanted, decomposition_state& state) {
  if (!wanted.smaller_sizes.empty()) {
    state.size.refine(wanted.smaller_sizes);
    state.faults = wanted.faults;
    ++state.refinements;
  }
  if (!wanted.merges.empty()) {
    const local_id before = state.merges.merged();
    state.merges.merge(state.subdomain_of_element, wanted.merges);
    if (wanted.is_after_failure)
      state.merged_after_failure += state.merges.merged() - before;
  }
}

namespace detail {

/// More rounds of smaller triangles are not worth it where something else helps as well.
inline int rounds_before_others(int refinement_rounds) {
  return std::min(refinement_rounds, 2);
}

/// Two CAD faces that cross, or one that is folded over: smaller triangles there. A fold of which these make
/// more, or that two rounds leave, may come from how interfaces cut the face: fewer subdomains. Throws
/// `intersection_error` that names the faces when no round is left, or there cannot be fewer.
inline repair repair_of_surfaces(const suppression_plan& plan, const decomposition_state& state,
                                 const geometry_topology& topology, int refinement_rounds) {
  const bool is_folded = !plan.folds.empty();
  const bool gets_worse = is_folded && are_multiplied(state.faults, plan.surface_crossings.size());
  const auto least_subdomains = std::max<std::size_t>(1, topology.solids.size());
  const bool can_be_fewer = static_cast<std::size_t>(state.merges.subdomains()) > least_subdomains;
  if (is_folded && can_be_fewer &&
      (gets_worse || state.refinements >= rounds_before_others(refinement_rounds)))
    return {.too_many_merges = plan.folds}; // whole faces may not fold
  if (state.refinements >= refinement_rounds || gets_worse)
    throw_crossing_faces(topology, plan.surface_crossings.front().cad_faces);
  return {.smaller_sizes = balls_around(plan.surface_crossings),
          .faults = is_folded ? plan.surface_crossings.size() : 0};
}

/// Interfaces that cross something: the two subdomains are merged. Where that is too many, or lines are at
/// fault, first smaller triangles, which are nearer to the surface, and so farther from the interfaces
/// inside.
inline repair repair_of_interfaces(const suppression_plan& plan, const decomposition_state& state,
                                   int refinement_rounds) {
  const bool may_refine =
      !plan.interface_crossings.empty() && state.refinements < rounds_before_others(refinement_rounds);
  const auto refined = [&] {
    return repair{.smaller_sizes = balls_around(one_of_each_place(plan.interface_crossings))};
  };
  if (!plan.lines_at_fault.empty() && may_refine)
    return refined();
  if (!plan.merges_suffice)
    throw mesher_error(plan.lines_at_fault);
  const std::string refusal = state.merges.refusal_of(plan.merges);
  if (refusal.empty())
    return {.merges = plan.merges};
  if (may_refine)
    return refined();
  return {.too_many_merges = refusal + ": their interfaces cross the surface"};
}

} // namespace detail

DOVETAIL_INLINE std::optional<repair> repair_of_crossings(const suppression_plan& plan,
                                                          const decomposition_state& state,
                                                          const geometry_topology& topology,
                                                          int refinement_rounds) {
  if (plan.empty())
    return {};
  if (!plan.surface_crossings.empty() && plan.merges.empty())
    return detail::repair_of_surfaces(plan, state, topology, refinement_rounds);
  return detail::repair_of_interfaces(plan, state, refinement_rounds);
}

} // namespace dovetail
