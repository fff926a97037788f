/// @file
/// The repairs of a decomposition: where surfaces or interfaces cross, or pieces cannot be meshed, smaller
/// sizes or the merge of two subdomains (paper, section 3.6). Each step looks at what there is and proposes
/// one repair, or none; `decomposition_rounds` does it and begins again, until no step proposes any.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/sizing/refined_sizing.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// What repairs change: the subdomains of the background mesh's elements, and the sizes.
struct decomposition_state {
  std::vector<local_id> subdomain_of_element; ///< by element of the background mesh
  merge_account merges;                       ///< which subdomains were merged, and why
  refined_sizing size;                        ///< the field given, smaller where something crossed
  int refinements = 0;                        ///< repairs by smaller sizes so far
  local_id merged_after_failure = 0;          ///< subdomains merged since a piece could not be meshed
  std::vector<std::string> warnings = {};     ///< what the report is to tell
};

/// One repair: smaller sizes, merges, or the insight that only fewer subdomains would do.
struct repair {
  std::vector<size_ball> smaller_sizes = {};        ///< balls in which sizes get smaller
  std::vector<std::array<local_id, 2>> merges = {}; ///< pairs of subdomains that become one
  std::string too_many_merges = {};                 ///< why fewer subdomains have to be made
  bool is_after_failure = false;                    ///< the merges are of pieces that no attempt could mesh
  std::vector<std::string> warnings = {};           ///< what the report is to tell

  /// Whether it repairs anything.
  bool changes_anything() const { return !smaller_sizes.empty() || !merges.empty(); }
};

/// Does a repair that changes something.
inline void apply(const repair& wanted, decomposition_state& state) {
  if (!wanted.smaller_sizes.empty()) {
    state.size.refine(wanted.smaller_sizes);
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

/// Two CAD faces that cross, or one that is folded over: smaller triangles there. Throws
/// `intersection_error` that names the faces when no round is left.
inline repair repair_of_surfaces(const suppression_plan& plan, const decomposition_state& state,
                                 const geometry_topology& topology, int refinement_rounds) {
  const auto least_subdomains = std::max<std::size_t>(1, topology.solids.size());
  const bool can_be_fewer = static_cast<std::size_t>(state.merges.subdomains()) > least_subdomains;
  if (!plan.folds.empty() && can_be_fewer && state.refinements >= rounds_before_others(refinement_rounds))
    return {.too_many_merges = plan.folds}; // whole faces may not fold
  if (state.refinements == refinement_rounds)
    throw_crossing_faces(topology, plan.surface_crossings.front().cad_faces);
  return {.smaller_sizes = balls_around(plan.surface_crossings)};
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

/// What is to be done about crossings. Throws `intersection_error` when two CAD faces cross, and
/// `mesher_error` when lines are at fault that no merge removes.
inline std::optional<repair> repair_of_crossings(const suppression_plan& plan,
                                                 const decomposition_state& state,
                                                 const geometry_topology& topology, int refinement_rounds) {
  if (plan.empty())
    return {};
  if (!plan.surface_crossings.empty() && plan.merges.empty())
    return detail::repair_of_surfaces(plan, state, topology, refinement_rounds);
  return detail::repair_of_interfaces(plan, state, refinement_rounds);
}

/// Smaller sizes at the faults of surfaces by which pieces have failed, as long as there are rounds.
inline std::optional<repair> refine_faults(const std::vector<surface_crossing>& faults) {
  if (faults.empty())
    return {};
  return repair{.smaller_sizes = balls_around(one_of_each_place(faults))};
}

/// Merges of what no attempt could mesh, each with a neighbour; only a warning where that would be too many.
template <int D>
std::optional<repair> merge_failures(const simplicial_skeleton<D>& skeleton,
                                     const std::vector<piece_failure>& failures,
                                     const decomposition_state& state) {
  std::vector<local_id> failed;
  for (const piece_failure& failure : failures)
    failed.push_back(failure.subdomain);
  repair wanted{.merges = merges_of_failed(skeleton, failed), .is_after_failure = true};
  if (wanted.merges.empty())
    return {};
  const std::string refusal = state.merges.refusal_of(wanted.merges);
  if (!refusal.empty())
    wanted.merges.clear();
  for (const piece_failure& failure : failures)
    wanted.warnings.push_back("no attempt could mesh a subdomain, " +
                              (refusal.empty() ? "merged with a neighbour" : "and " + refusal) + ": " +
                              joined_reasons(failure.reasons));
  return wanted;
}

} // namespace dovetail
