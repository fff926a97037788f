/// @file
/// The rounds in which a decomposition becomes pieces: its boundaries are remeshed and its pieces meshed, and
/// what fails or crosses is repaired and done again, to a fixpoint (paper, sections 3.5, 3.6 and 4).
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/parallel/run_results.hpp"
#include "dovetail/pipeline/crossings.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/fine_angles.hpp"
#include "dovetail/pipeline/given_up.hpp"
#include "dovetail/pipeline/piece_meshing.hpp"
#include "dovetail/pipeline/repairs.hpp"
#include "dovetail/pipeline/repartition_rounds.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Lines, patches and pieces are kept from round to round, so that one makes again only what the one before
/// has changed. Model, mesh and its division must outlive this. `account` is that of decompositions that were
/// given up before, to which this one's is added.
template <int D, bound_parameters<D> Parameters>
class decomposition_rounds {
public:
  decomposition_rounds(const any_geometry& model, const simplicial_background<D>& mesh,
                       const divided_background<D>& divided, const any_sizing& size, const Parameters& given,
                       report account = {})
      : model_(model), mesh_(mesh), divided_(divided),
        given_(with_memory(given)), state_{.subdomain_of_element = divided.pieces.part_of_element,
                                           .merges = {divided.pieces.parts,
                                                      given.options.largest_merged_fraction},
                                           .size = size},
        repartition_(mesh, divided, given.options.repartition_locally), made_(given_.run_tasks),
        account_(std::move(account)), counts_(account_.as<intersection_counts>()) {
    account_.name = "intersection";
    if (given.options.alone) {
      require_wanted();
      const auto& wanted = given.options.only;
      element_of_wanted_.resize(wanted.size());
      for (std::size_t e = 0; e < state_.subdomain_of_element.size(); ++e)
        if (const auto found = std::lower_bound(wanted.begin(), wanted.end(), state_.subdomain_of_element[e]);
            found != wanted.end() && *found == state_.subdomain_of_element[e])
          element_of_wanted_[static_cast<std::size_t>(found - wanted.begin())] = e;
    }
  }

  decomposition_rounds(any_geometry&&, const simplicial_background<D>&, const divided_background<D>&,
                       const any_sizing&, const Parameters&, report = {}) = delete;

  const merge_account& merges() const { return state_.merges; } ///< which subdomains were merged, and why
  /// The field given, smaller where something crossed.
  any_sizing size() const { return state_.size.everywhere(); }
  /// What was found and done so far, `intersection_counts`. Its time is also that of measuring interface
  /// angles and of local repartition.
  report intersection() const {
    intersection_counts counts = counts_;
    counts.refinements += state_.refinements;
    counts.merges += state_.merges.merged() - state_.merged_after_failure;
    counts.merged_after_failure += state_.merged_after_failure;
    counts.largest_merged = std::max(counts.largest_merged, state_.merges.largest());
    report account = account_;
    account.set(counts);
    return account;
  }
  /// The subdomains of which alone pieces are made, as they are numbered now; empty: all.
  const std::vector<local_id>& wanted() const { return given_.options.only; }
  /// Why too many subdomains would have to be merged; empty as long as they would not.
  const std::string& too_many_merges() const { return too_many_merges_; }
  /// The interface angles of what was last realized as a whole, or around the pieces that alone are made.
  interface_angles take_fine_angles() { return std::move(angles_); }

  /// For a decomposition that is not gone on with: its finished pieces are not kept. Returns the account,
  /// with what was told as warnings.
  report give_up() {
    forget(given_.run_tasks, name_of_pieces, finished_);
    report account = intersection();
    append(account.warnings, state_.warnings);
    add_time(account, "skeleton", skeleton_seconds_);
    add_time(account, "meshing", meshing_seconds_);
    return account;
  }

  /// Remeshes the boundaries until no patch fails and none crosses another, and interfaces keep clear of the
  /// places where remeshing makes an angle of theirs small, as far as that can be. Nothing where
  /// `too_many_merges`. Throws `intersection_error` when two CAD faces cross, `mesher_error` when a patch
  /// cannot be remeshed.
  std::optional<realized<D>> realize_boundaries() {
    for (;;) {
      auto made = realize_once();
      if (repaired_by([&] { return crossings_of(boundaries_plan(made, counts_)); }))
        continue;
      if (!too_many_merges_.empty())
        return {};
      return with_clean_angles(std::move(made));
    }
  }

  /// The same with the pieces meshed. What neither the mesher nor a fallback can mesh is refined where a
  /// surface is at fault, or merged with a neighbour, as long as that may be; what then fails still is data.
  /// Where only some pieces are wanted, nothing of this is repaired: nobody knows what others would do.
  /// Throws `usage_error` when one is wanted that there is not.
  std::optional<std::pair<realized<D>, meshed_pieces<D>>> mesh_pieces() {
    while (auto made = realize_boundaries()) {
      require_wanted();
      auto meshed = mesh_wanted_pieces(model_, mesh_, *made, divided_.weights, state_.size, given_);
      meshing_seconds_ += meshed.summary.seconds;
      finished_.insert(meshed.finished.begin(), meshed.finished.end());
      const auto refine = [&] { return refine_faults(faults_of(*made, meshed), state_); };
      const auto merge = [&] { return merge_failures<D>(made->fine, meshed.failures, state_); };
      const auto uncross = [&] {
        return crossings_of(plan_for_pieces(model_, *made, meshed, given_, counts_, account_.seconds));
      };
      if (given_.options.only.empty() && repaired_by(refine, merge, uncross))
        continue;
      if (!too_many_merges_.empty())
        break;
      append(meshed.summary.warnings, state_.warnings);
      meshed.summary.seconds = meshing_seconds_;
      return std::pair(*std::move(made), std::move(meshed));
    }
    return {};
  }

private:
  /// Does the first repair that changes anything, of those that these steps propose in turn; whether there
  /// was one.
  template <class... Steps>
  bool repaired_by(const Steps&... steps) {
    const auto does = [&](const auto& step) {
      const std::optional<repair> wanted = step();
      if (!wanted)
        return false;
      append(state_.warnings, wanted->warnings);
      too_many_merges_ = wanted->too_many_merges;
      apply(*wanted, state_);
      if (given_.options.alone && wanted->changes_anything()) {
        follow_wanted();
        if (sees_part_)
          warn_of_unseen();
      }
      return wanted->changes_anything();
    };
    return (does(steps) || ...);
  }

  suppression_plan boundaries_plan(const realized<D>& made, intersection_counts& counts) {
    return plan_for_boundaries(made, made_, given_, counts, account_.seconds);
  }
  std::optional<repair> crossings_of(const suppression_plan& plan) const {
    return repair_of_crossings(plan, state_, model_.topology(), given_.options.refinement_rounds);
  }
  std::vector<surface_crossing> faults_of(const realized<D>& made, const meshed_pieces<D>& meshed) {
    if (meshed.failures.empty() || state_.refinements == given_.options.refinement_rounds)
      return {};
    return faults_of_failed_pieces(model_, mesh_, made, meshed.failures, state_.size, made_, given_);
  }

  /// Where something crosses, if something does; crossings of lines have no place.
  static std::optional<std::vector<vec3>> places_of_crossings(const suppression_plan& plan) {
    if (plan.empty())
      return {};
    std::vector<vec3> places;
    for (const auto* crossings : {&plan.interface_crossings, &plan.surface_crossings})
      for (const surface_crossing& crossing : *crossings)
        places.push_back(crossing.center);
    return places;
  }

  /// What was wanted by its number before merges is wanted by the one that it has now.
  void follow_wanted() {
    given_.options.only.clear();
    for (const std::size_t e : element_of_wanted_)
      given_.options.only.push_back(state_.subdomain_of_element[e]);
    sort_unique(given_.options.only);
  }
  /// What is done about crossings is decided from all of them, of which only those around some pieces are
  /// seen.
  void warn_of_unseen() {
    const std::string warning = "boundaries crossed around these pieces and were repaired; with what crosses "
                                "elsewhere the whole mesh may be repaired otherwise there, so that pieces "
                                "made in other runs may not fit";
    auto& warnings = state_.warnings;
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
      warnings.push_back(warning);
  }

  realized<D> realize_once() {
    if constexpr (D == 3)
      if (given_.options.alone)
        return counted(realize_around(model_, mesh_, divided_, state_.subdomain_of_element, subdomains(),
                                      state_.size, made_, given_));
    return counted(realize<D>(model_, mesh_, divided_, state_.subdomain_of_element, subdomains(), state_.size,
                              made_, given_));
  }
  realized<D> counted(realized<D> made) {
    sees_part_ = made.is_part;
    skeleton_seconds_ += made.summary.seconds;
    made.summary.seconds = skeleton_seconds_;
    return made;
  }
  std::size_t subdomains() const { return static_cast<std::size_t>(state_.merges.subdomains()); }
  void require_wanted() const {
    for (const local_id wanted : given_.options.only)
      if (wanted < 0 || static_cast<std::size_t>(wanted) >= subdomains())
        throw usage_error("there is no subdomain " + std::to_string(wanted) + ": there are " +
                          std::to_string(subdomains()) + ", numbered from 0");
  }

  realized<D> with_clean_angles(realized<D> made) {
    if constexpr (D == 3) {
      const auto realize_part_of = [&](const auto& subdomain_of_element, const auto& is_wanted) {
        return counted(realize_part(model_, mesh_, divided_, subdomain_of_element, subdomains(), state_.size,
                                    made_, given_, is_wanted));
      };
      intersection_counts of_trials; // which are taken back where something crosses
      const std::size_t lines_before = made_.lines.made() - made.counts.lines_made;
      const std::size_t patches_before = made_.patches.meshes.made() - made.counts.patches_made;
      made = repartition_.avoid_small_angles(
          std::move(made), state_.subdomain_of_element, state_.merges.subdomains(),
          [&] { return realize_once(); }, realize_part_of,
          [&](const realized<3>& made_so) {
            return places_of_crossings(boundaries_plan(made_so, of_trials));
          },
          [&](const realized<3>& made_so) { return small_angles_of(made_so); }, account_.seconds);
      made.counts.lines_made = made_.lines.made() - lines_before;
      made.counts.patches_made = made_.patches.meshes.made() - patches_before;
      made.summary.set(made.counts);
      made.summary.seconds = skeleton_seconds_;
    } else {
      small_angles_of(made); // corners between lines: there is no place that these could avoid
    }
    return made;
  }

  /// Measures the interface angles; returns the places of those that are small and not forced.
  places_of_angles small_angles_of(const realized<D>& made) {
    const stopwatch clock;
    given_.options.on_progress("intersection", 0, 0);
    auto angles =
        detail::fine_interface_angles(made, mesh_, divided_, size(), wanted_angles_of<D>(given_.simplify_by),
                                      given_.run_tasks, given_.options.on_progress.only_stopping());
    auto places = detail::places_of_small_angles(made, angles);
    if (!made.is_part || given_.options.alone)
      angles_ = std::move(angles);
    account_.seconds += clock.seconds();
    return places;
  }

  const any_geometry& model_;
  const simplicial_background<D>& mesh_;
  const divided_background<D>& divided_;
  Parameters given_;
  decomposition_state state_;
  repartition_rounds<D> repartition_;
  interface_angles angles_; ///< of what was last realized as a whole, or around what is wanted
  skeleton_memo made_;
  std::set<kept<finished_piece<D>>> finished_; ///< of all rounds
  report account_;                             ///< of decompositions before and of this one
  intersection_counts counts_;
  double skeleton_seconds_ = 0;
  double meshing_seconds_ = 0;
  std::string too_many_merges_;
  bool sees_part_ = false;                     ///< of the skeleton, in what was last realized
  std::vector<std::size_t> element_of_wanted_; ///< one of each, where the skeleton is made around these alone
};

} // namespace dovetail
