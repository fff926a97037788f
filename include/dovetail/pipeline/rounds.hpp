/// @file
/// The rounds in which a decomposition becomes pieces: its boundaries are remeshed and its pieces meshed, and
/// what fails or crosses is merged or refined and done again, to a fixpoint (paper, sections 3.5, 3.6 and 4).
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/pipeline/crossings.hpp"
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
/// has changed. Model, mesh and sides must outlive this. `account` is that of decompositions that were given
/// up before, to which this one's is added.
template <int D>
class decomposition_rounds {
public:
  decomposition_rounds(const any_geometry& model, const simplicial_background<D>& mesh,
                       const side_table<D>& sides, decomposition pieces, const any_sizing& size,
                       const any_parameters<D>& given, report account = {})
      : model_(model), mesh_(mesh), sides_(sides), given_(given),
        subdomain_of_element_(std::move(pieces.part_of_element)),
        merges_(pieces.parts, given.options.largest_merged_fraction), size_(size),
        made_(std::make_shared<entity_store>(given.options.store, "skeleton")),
        pieces_(std::make_shared<entity_store>(given.options.store)), intersection_(std::move(account)) {
    intersection_.name = "intersection";
  }

  decomposition_rounds(any_geometry&&, const simplicial_background<D>&, const side_table<D>&, decomposition,
                       const any_sizing&, const any_parameters<D>&, report = {}) = delete;

  const merge_account& merges() const { return merges_; }
  /// The field given, smaller where something crossed.
  any_sizing size() const { return size_.everywhere(); }
  /// What was found and done so far: "crossings", "rounds", "refinements", "merges", "merged_after_failure",
  /// "largest_merged".
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
    if (given_.run_tasks.leads())
      for (const content_key key : finished_)
        pieces_->release(key);
    report account = intersection();
    append(account.warnings, told_);
    return account;
  }

  /// Remeshes the boundaries until no patch fails and none crosses another. Throws `intersection_error` when
  /// two CAD faces cross, `too_many_merges` when too many subdomains would have to be merged in all,
  /// `mesher_error` when a patch cannot be remeshed.
  realized<D> realize_boundaries() {
    for (;;) {
      auto made = realize<D>(model_, mesh_, sides_, subdomain_of_element_,
                             static_cast<std::size_t>(merges_.subdomains()), size_, made_, given_);
      const bool whole = suppress(plan_for_boundaries(made, made_, given_, intersection_));
      skeleton_seconds_ += made.summary.seconds;
      made.summary.seconds = skeleton_seconds_;
      if (whole)
        return made;
    }
  }

  /// The same with the pieces meshed, of which `weights` are the costs per coarse element. What no rung of
  /// the mesher's ladder can mesh is merged with a neighbour, as long as that may be.
  std::pair<realized<D>, meshed_pieces<D>> mesh_pieces(std::span<const double> weights) {
    for (;;) {
      auto made = realize_boundaries();
      auto meshed = mesh_all_pieces(model_, mesh_, made, weights, size_, pieces_, given_);
      finished_.insert(meshed.keys.begin(), meshed.keys.end());
      if (merge_failed(made, meshed) ||
          !suppress(plan_for_pieces(model_, made, meshed, given_, intersection_)))
        continue;
      append(meshed.summary.warnings, told_);
      return {std::move(made), std::move(meshed)};
    }
  }

private:
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

  const any_geometry& model_;
  const simplicial_background<D>& mesh_;
  const side_table<D>& sides_;
  any_parameters<D> given_;
  std::vector<local_id> subdomain_of_element_;
  merge_account merges_;
  refined_sizing size_; ///< the field given, smaller where something crossed
  skeleton_store made_;
  std::shared_ptr<entity_store> pieces_;
  std::set<content_key> finished_; ///< pieces, of all rounds
  report intersection_;
  double skeleton_seconds_ = 0;
  int refinements_ = 0;
  local_id merged_after_failure_ = 0;
  std::vector<std::string> told_;
};

} // namespace dovetail
