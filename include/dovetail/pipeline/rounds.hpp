/// @file
/// The rounds in which a decomposition becomes pieces: its boundaries are remeshed and its pieces meshed, and
/// what fails or crosses is merged or refined and done again, to a fixpoint (paper, sections 3.5, 3.6 and 4).
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/detours.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/pipeline/crossings.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/fine_angles.hpp"
#include "dovetail/pipeline/piece_meshing.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Lines, patches and pieces are kept from round to round, so that one makes again only what the one before
/// has changed. Model, mesh and its division must outlive this. `account` is that of decompositions that were
/// given up before, to which this one's is added.
template <int D>
class decomposition_rounds {
public:
  decomposition_rounds(const any_geometry& model, const simplicial_background<D>& mesh,
                       const divided_background<D>& divided, const any_sizing& size,
                       const any_parameters<D>& given, report account = {})
      : model_(model), mesh_(mesh), divided_(divided), given_(given),
        subdomain_of_element_(divided.pieces.part_of_element),
        merges_(divided.pieces.parts, given.options.largest_merged_fraction), size_(size),
        detours_(mesh.elements(), divided.sides, divided.pieces),
        made_(std::make_shared<entity_store>(given.options.store, "skeleton")),
        pieces_(std::make_shared<entity_store>(given.options.store)), intersection_(std::move(account)) {
    intersection_.name = "intersection";
  }

  decomposition_rounds(any_geometry&&, const simplicial_background<D>&, const divided_background<D>&,
                       const any_sizing&, const any_parameters<D>&, report = {}) = delete;

  const merge_account& merges() const { return merges_; }
  /// The field given, smaller where something crossed.
  any_sizing size() const { return size_.everywhere(); }
  /// What was found and done so far: "crossings", "rounds", "refinements", "merges", "merged_after_failure",
  /// "largest_merged". Its time is also that of measuring interface angles and of finding detours.
  report intersection() const {
    report account = intersection_;
    account.add("refinements", refinements_);
    account.add("merges", merges_.merged() - merged_after_failure_);
    account.add("merged_after_failure", merged_after_failure_);
    account.set("largest_merged", std::max<double>(account.get("largest_merged"), merges_.largest()));
    return account;
  }

  /// For a decomposition that is not gone on with: its finished pieces are removed from the store. Returns
  /// the account, with what was told as warnings.
  report give_up() {
    if (given_.run_tasks.leads() || !pieces_->is_common())
      for (const content_key key : finished_)
        pieces_->release(key);
    report account = intersection();
    append(account.warnings, told_);
    return account;
  }

  /// The interface angles of what was last realized.
  interface_angles take_fine_angles() { return std::move(angles_); }

  /// Remeshes the boundaries until no patch fails and none crosses another, and interfaces keep clear of the
  /// places where remeshing makes an angle of theirs small, as far as that can be. Throws
  /// `intersection_error` when two CAD faces cross, `too_many_merges` when too many subdomains would have to
  /// be merged in all, `mesher_error` when a patch cannot be remeshed.
  realized<D> realize_boundaries() {
    for (;;) {
      auto made = realize_once();
      if (suppress(plan_for_boundaries(made, made_, given_, intersection_)))
        return with_clean_angles(std::move(made));
    }
  }

  /// The same with the pieces meshed. What no rung of the mesher's ladder can mesh is refined where a surface
  /// is at fault, or merged with a neighbour, as long as that may be.
  std::pair<realized<D>, meshed_pieces<D>> mesh_pieces() {
    for (;;) {
      auto made = realize_boundaries();
      auto meshed = mesh_all_pieces(model_, mesh_, made, divided_.weights, size_, pieces_, given_);
      finished_.insert(meshed.keys.begin(), meshed.keys.end());
      if (refine_failed(made, meshed) || merge_failed(made, meshed) ||
          !suppress(plan_for_pieces(model_, made, meshed, given_, intersection_)))
        continue;
      append(meshed.summary.warnings, told_);
      return {std::move(made), std::move(meshed)};
    }
  }

private:
  realized<D> realize_once() {
    auto made = realize<D>(model_, mesh_, divided_, subdomain_of_element_,
                           static_cast<std::size_t>(merges_.subdomains()), size_, made_, given_);
    skeleton_seconds_ += made.summary.seconds;
    made.summary.seconds = skeleton_seconds_;
    return made;
  }

  /// Lets interfaces make detours around places where remeshing made an angle small, and takes the best of
  /// what was realized on the way. A detour by which something crosses is none. Where the coarse interfaces
  /// have such angles already, the rule does not care for them.
  realized<D> with_clean_angles(realized<D> made) {
    auto places = small_angles_of(made);
    auto best = std::pair(places.size(), subdomain_of_element_);
    while (!places.empty() && places.size() <= most_detours && detour_rounds_ < most_detour_rounds &&
           divided_.angles.count(violation_cause::remeshing) == 0) {
      const auto before = subdomain_of_element_;
      const stopwatch clock;
      const std::size_t moved = detours_.avoid(places, subdomain_of_element_, merges_.subdomains());
      intersection_.seconds += clock.seconds();
      if (moved == 0)
        break;
      ++detour_rounds_;
      made = realize_once();
      if (!plan_for_boundaries(made, made_, given_, intersection_).empty()) {
        subdomain_of_element_ = before;
        made = realize_once();
        continue;
      }
      detours_made_ += moved;
      places = small_angles_of(made);
      if (places.size() < best.first)
        best = {places.size(), subdomain_of_element_};
    }
    if (places.size() > best.first) {
      subdomain_of_element_ = std::move(best.second);
      made = realize_once();
      small_angles_of(made);
    }
    made.summary.set("detour_rounds", detour_rounds_);
    made.summary.set("detours", static_cast<double>(detours_made_));
    return made;
  }

  /// Measures the interface angles; returns the coarse sides at each that is small and not forced.
  std::vector<std::vector<local_id>> small_angles_of(const realized<D>& made) {
    const stopwatch clock;
    given_.options.on_progress("intersection", 0, 0);
    auto [angles, places] = given_.run_tasks.once([&] {
      auto measured = detail::fine_interface_angles(made, mesh_, divided_, size(),
                                                    wanted_angles_of<D>(given_.simplify_by));
      auto small = detail::places_of_small_angles(made, measured);
      return std::pair(std::move(measured), std::move(small));
    });
    angles_ = std::move(angles);
    intersection_.seconds += clock.seconds();
    return std::move(places);
  }

  /// Whether nothing is to be done; does it otherwise.
  bool suppress(const suppression_plan& plan) {
    if (plan.empty())
      return true;
    if (!plan.surface_crossings.empty() && plan.merges.empty()) {
      const int rounds = given_.options.refinement_rounds;
      if (!plan.folds.empty() && refinements_ >= std::min(rounds, 2) && can_be_fewer())
        throw too_many_merges(plan.folds); // whole faces may not fold
      if (refinements_ == rounds)
        throw_crossing_faces(model_.topology(), plan.surface_crossings.front().cad_faces);
      refine(plan.surface_crossings);
    } else if (!plan.lines_at_fault.empty() && may_refine_instead(plan)) {
      refine(one_of_each_place(plan.interface_crossings));
    } else if (!plan.merges_suffice) {
      throw mesher_error(plan.lines_at_fault);
    } else if (const std::string refused = merges_.merge(subdomain_of_element_, plan.merges);
               !refused.empty()) {
      if (!may_refine_instead(plan))
        throw too_many_merges(refused + ": their interfaces cross the surface");
      refine(one_of_each_place(plan.interface_crossings));
    }
    return false;
  }

  /// Each solid is a subdomain at least.
  bool can_be_fewer() const {
    return static_cast<std::size_t>(merges_.subdomains()) >
           std::max<std::size_t>(1, model_.topology().solids.size());
  }

  /// Smaller triangles are nearer to the surface, and so farther from the interfaces inside. More rounds of
  /// them are not worth it where merging helps as well.
  bool may_refine_instead(const suppression_plan& plan) const {
    return !plan.interface_crossings.empty() && refinements_ < std::min(given_.options.refinement_rounds, 2);
  }

  void refine(std::span<const surface_crossing> crossings) {
    size_.refine(balls_around(crossings));
    ++refinements_;
  }

  /// Smaller sizes where no attempt could mesh a surface; whether there are such places and rounds left.
  bool refine_failed(const realized<D>& made, const meshed_pieces<D>& meshed) {
    if (meshed.failures.empty() || refinements_ == given_.options.refinement_rounds)
      return false;
    const auto faults = faults_of_failed_pieces(model_, mesh_, made, meshed.failures, size_, made_, given_);
    if (!faults.empty())
      refine(one_of_each_place(faults));
    return !faults.empty();
  }

  /// Merges what no attempt could mesh; whether that changed anything.
  bool merge_failed(const realized<D>& made, const meshed_pieces<D>& meshed) {
    std::vector<local_id> failed;
    for (const piece_failure& failure : meshed.failures)
      failed.push_back(failure.subdomain);
    const auto merges = merges_of_failed(made.fine, failed);
    if (merges.empty())
      return false;
    const local_id before = merges_.merged();
    const std::string refused = merges_.merge(subdomain_of_element_, merges);
    merged_after_failure_ += merges_.merged() - before;
    for (const piece_failure& failure : meshed.failures)
      told_.push_back("no attempt could mesh a subdomain, " +
                      (refused.empty() ? "merged with a neighbour" : "and " + refused) + ": " +
                      joined_reasons(failure.reasons));
    return refused.empty();
  }

  /// Each takes the time of what it changes, and mostly two are enough.
  static constexpr int most_detour_rounds = 8;
  /// With more small angles the decomposition is poor as a whole: detours would take longer than all the
  /// rest.
  static constexpr std::size_t most_detours = 32;

  const any_geometry& model_;
  const simplicial_background<D>& mesh_;
  const divided_background<D>& divided_;
  any_parameters<D> given_;
  std::vector<local_id> subdomain_of_element_;
  merge_account merges_;
  refined_sizing size_; ///< the field given, smaller where something crossed
  interface_detours<D> detours_;
  interface_angles angles_; ///< of what was last realized
  skeleton_store made_;
  std::shared_ptr<entity_store> pieces_;
  std::set<content_key> finished_; ///< pieces, of all rounds
  report intersection_;
  double skeleton_seconds_ = 0;
  int refinements_ = 0;
  int detour_rounds_ = 0;
  std::size_t detours_made_ = 0; ///< super-elements that changed their subdomain for one
  local_id merged_after_failure_ = 0;
  std::vector<std::string> told_;
};

} // namespace dovetail
