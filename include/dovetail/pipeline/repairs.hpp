/// @file
/// The repairs of a decomposition: where surfaces or interfaces cross, or pieces cannot be meshed, smaller
/// sizes or the merge of two subdomains (paper, section 3.6). Each step looks at what there is and proposes
/// one repair, or none; `decomposition_rounds` does it and begins again, until no step proposes any.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/remesh/folds.hpp"
#include "dovetail/sizing/refined_sizing.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <array>
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
  std::size_t faults = 0; ///< folded triangles and the like that the last of them was for; 0: others
  local_id merged_after_failure = 0;      ///< subdomains merged since a piece could not be meshed
  std::vector<std::string> warnings = {}; ///< what the report is to tell
};

/// One repair: smaller sizes, merges, or the insight that only fewer subdomains would do.
struct repair {
  std::vector<size_ball> smaller_sizes = {};        ///< balls in which sizes get smaller
  std::size_t faults = 0;                           ///< folded triangles and the like that these are for
  std::vector<std::array<local_id, 2>> merges = {}; ///< pairs of subdomains that become one
  std::string too_many_merges = {};                 ///< why fewer subdomains have to be made
  bool is_after_failure = false;                    ///< the merges are of pieces that no attempt could mesh
  std::vector<std::string> warnings = {};           ///< what the report is to tell

  /// Whether it repairs anything.
  bool changes_anything() const { return !smaller_sizes.empty() || !merges.empty(); }
};

/// Does a repair that changes something.
void apply(const repair& wanted, decomposition_state& state);

/// What is to be done about crossings. Throws `intersection_error` when two CAD faces cross, and
/// `mesher_error` when lines are at fault that no merge removes.
/// \param refinement_rounds how often sizes may be refined at crossings
std::optional<repair> repair_of_crossings(const suppression_plan& plan, const decomposition_state& state,
                                          const geometry_topology& topology, int refinement_rounds);

/// Smaller sizes at the faults of surfaces by which pieces have failed, as long as there are rounds and these
/// do not make it worse.
inline std::optional<repair> refine_faults(const std::vector<surface_crossing>& faults,
                                           const decomposition_state& state) {
  if (faults.empty() || are_multiplied(state.faults, faults.size()))
    return {};
  return repair{.smaller_sizes = balls_around(one_of_each_place(faults)), .faults = faults.size()};
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

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/repairs.ipp"
#endif
