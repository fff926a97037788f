/// @file
/// Bounded contraction: the nodes of an element-dual graph are merged across all edges that may not become
/// interfaces, those of a side-dual graph deleted with them.
///
/// Section 3.3 of J. Chen et al., "Scalable generation of large-scale unstructured meshes by a novel domain
/// decomposition approach": coupled sides (S0), sides of bad shape (S1), then node deletion on the SDG,
/// smallest dihedral first (S2). All contractions are bounded: one that would make a super-element too heavy
/// is refused, and the side's weight is multiplied by its penalty in the contracted graph instead, so that
/// the partitioner avoids it.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/simplification/dihedral_runs.hpp"
#include "dovetail/simplification/types.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <queue>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Throws `usage_error` unless a rule judged each of so many sides.
inline void require_one_each(const side_judgement& judged, std::size_t sides) {
  if (judged.quality.size() != sides)
    throw usage_error("the simplification rule judged " + std::to_string(judged.quality.size()) +
                      " sides of " + std::to_string(sides) + "; it must give one quality each");
}

/// One run of the algorithm; `contract_bounded` calls its steps in order.
template <element_dual_graph Elements, side_dual_graph Sides, contraction_rule Rule>
class bounded_contraction {
public:
  bounded_contraction(const Elements& elements, const Sides& sides, side_judgement judged, const Rule& rule,
                      const contraction_bound& bound, const progress& on_progress)
      : elements_(elements), judged_(std::move(judged)), rule_(rule), weights_(weights_of(elements)),
        runs_(sides), supers_(weights_), refusals_(elements.side_count()), fixed_(elements.side_count(), 0),
        bound_(heaviest_allowed(bound)), on_progress_(on_progress) {
    for (std::size_t s = 0; s < fixed_.size(); ++s)
      fixed_[s] = elements.is_fixed(static_cast<local_id>(s)) ? 1 : 0;
    require_graphs();
    require_judgement();
  }

  void contract_coupled_sides(std::span<const coupled_side> coupled) {
    std::vector<coupled_side> candidates;
    for (const coupled_side& each : coupled) {
      if (is_fixed(each.side))
        continue;
      const deficit& missed = each.decision.missed;
      if (!(missed.value >= 0) || !(missed.wanted >= 0) || std::isinf(missed.value) ||
          std::isinf(missed.wanted))
        throw usage_error("the simplification rule propagates to side " + std::to_string(each.side) +
                          " since it misses " + number_text(missed.wanted) + " by being " +
                          number_text(missed.value) + "; both must be finite and not negative");
      candidates.push_back(each);
    }
    contract_worst_first(candidates);
  }

  void contract_bad_shapes() {
    std::vector<coupled_side> candidates;
    for (std::size_t s = 0; s < fixed_.size(); ++s)
      if (judged_.quality[s] < judged_.wanted_quality && fixed_[s] == 0)
        candidates.push_back({static_cast<local_id>(s), {{judged_.quality[s], judged_.wanted_quality}}});
    contract_worst_first(candidates);
  }

  void delete_small_dihedrals() {
    std::vector<queued_dihedral> first;
    for (dihedral_id w = 0; w < runs_.dihedral_count(); ++w)
      if (runs_.is_name(w) && is_small(runs_.angle(w)))
        first.push_back({runs_.angle(w), w});
    queue_ = dihedral_queue(std::greater<>(), std::move(first));
    queue_is_open_ = true;
    do {
      while (!queue_.empty()) {
        poll();
        const auto [angle, w] = queue_.top();
        queue_.pop();
        if (runs_.is_end(w) && runs_.angle(w) == angle) // else an older state of a run that has grown
          treat_dihedral(w, angle);
      }
      remove_refused_sides_inside();
    } while (!queue_.empty());
  }

  simplification result() {
    simplification out;
    out.side_states.resize(fixed_.size());
    auto numbered = supers_.number_sets();
    out.super_of_element = std::move(numbered.of_member);
    out.super_count = numbered.count;
    for (std::size_t s = 0; s < fixed_.size(); ++s) {
      if (fixed_[s] != 0) {
        out.side_states[s] = side_state::fixed;
      } else if (is_internal(static_cast<local_id>(s))) {
        out.side_states[s] = side_state::removed;
      } else if (refusals_[s].side != no_id) {
        out.side_states[s] = side_state::refused;
        out.refused.push_back(refusals_[s]);
      }
    }
    out.forced = std::move(forced_);
    out.graph = contracted_graph(out);
    out.quality = std::move(judged_.quality);
    summarize(out);
    return out;
  }

private:
  using queued_dihedral = std::pair<double, dihedral_id>; ///< ties by dihedral number
  using dihedral_queue = std::priority_queue<queued_dihedral, std::vector<queued_dihedral>, std::greater<>>;

  static std::vector<double> weights_of(const Elements& elements) {
    std::vector<double> weights(elements.element_count());
    for (std::size_t e = 0; e < weights.size(); ++e)
      weights[e] = elements.weight(static_cast<local_id>(e));
    return weights;
  }

  /// Before a rule is blamed for what comes of them.
  void require_graphs() const {
    for (std::size_t e = 0; e < weights_.size(); ++e)
      if (!(weights_[e] >= 0) || !std::isfinite(weights_[e]))
        throw usage_error("contraction: element " + std::to_string(e) + " has the weight " +
                          number_text(weights_[e]) + "; weights must be finite and not negative");
    for (dihedral_id d = 0; d < runs_.dihedral_count(); ++d)
      if (!std::isfinite(runs_.angle(d)))
        throw usage_error("contraction: the side-dual graph gives dihedral " + std::to_string(d) +
                          " the angle " + number_text(runs_.angle(d)) + "; angles must be finite");
  }
  /// The orders of sides and dihedrals are none where something is not a number.
  void require_judgement() const {
    require_one_each(judged_, fixed_.size());
    if (!(judged_.wanted_quality >= 0) || !(judged_.wanted_angle_deg >= 0))
      throw usage_error("the simplification rule wants the quality " + number_text(judged_.wanted_quality) +
                        " and dihedrals of " + number_text(judged_.wanted_angle_deg) +
                        " degrees; neither may be negative");
    for (std::size_t s = 0; s < fixed_.size(); ++s)
      if (fixed_[s] == 0 && !(judged_.quality[s] >= 0))
        throw usage_error("the simplification rule gave side " + std::to_string(s) + " the quality " +
                          number_text(judged_.quality[s]) + "; it must not be negative");
  }
  double side_weight(local_id side) const {
    const double weight = elements_.side_weight(side);
    if (!(weight >= 0) || !std::isfinite(weight))
      throw usage_error("side " + std::to_string(side) + " has the weight " + number_text(weight) +
                        "; it must be finite and not negative");
    return weight;
  }
  double penalty_of(const deficit& missed) const {
    const double penalty = rule_.penalty(missed);
    if (!(penalty > 0) || !std::isfinite(penalty))
      throw usage_error("the simplification rule gave a refused side the penalty " + number_text(penalty) +
                        "; it must be positive and finite");
    return penalty;
  }

  double heaviest_allowed(const contraction_bound& bound) const {
    const double total = std::accumulate(weights_.begin(), weights_.end(), 0.0);
    const auto n = static_cast<double>(weights_.size());
    return std::max(bound.fraction * total / std::max(1.0, bound.subdomains),
                    n > 0 ? bound.always_allowed_elements * total / n : 0.0);
  }

  bool is_fixed(local_id side) const { return fixed_[side] != 0; }
  bool is_refused(local_id side) const { return refusals_[side].side != no_id; }
  bool is_small(double angle) const { return angle < judged_.wanted_angle_deg; }
  /// Both elements are in one super-element, so the side can never become an interface.
  bool is_internal(local_id side) {
    const auto [a, b] = elements_.elements(side);
    return !is_fixed(side) && supers_.find(a) == supers_.find(b);
  }

  void contract_worst_first(std::vector<coupled_side>& candidates) {
    sort_all(candidates, [](const coupled_side& a, const coupled_side& b) {
      const auto key = [](const coupled_side& c) {
        const deficit& missed = c.decision.missed;
        return std::tuple(missed.value - missed.wanted, c.side, c.decision.only_penalise);
      };
      return key(a) < key(b);
    });
    for (const coupled_side& c : candidates) {
      poll();
      if (c.decision.only_penalise)
        refuse(c.side, c.decision.missed);
      else
        remove_or_refuse(c.side, c.decision.missed);
    }
  }

  /// Asks whether to stop, at some steps of many.
  void poll() {
    if (++steps_ % 16384 == 0)
      on_progress_.stop_if_requested();
  }

  void treat_dihedral(dihedral_id w, double angle) {
    const auto [a, b] = runs_.bounding_sides(w);
    // Sides that became internal by other contractions are only noticed here: joining their runs puts the
    // grown run back into the queue when it is still small.
    for (const local_id side : {a, b})
      if (is_internal(side)) {
        remove(side);
        return;
      }
    if (is_fixed(a) && is_fixed(b)) {
      forced_.push_back({{std::min(a, b), std::max(a, b)}, angle});
      return;
    }
    if (is_refused(a) || is_refused(b)) {
      beside_refused_.push_back(w);
      return;
    }
    remove_or_refuse(which_goes(a, b), {angle, judged_.wanted_angle_deg});
  }

  /// A side that was only to be penalised may have become internal since a dihedral at it was left alone:
  /// the dihedrals joined there may be small, too.
  void remove_refused_sides_inside() {
    for (const dihedral_id w : std::exchange(beside_refused_, {})) {
      if (!runs_.is_end(w))
        continue;
      const auto [a, b] = runs_.bounding_sides(w);
      if (is_internal(a) || is_internal(b))
        remove(is_internal(a) ? a : b);
      else
        beside_refused_.push_back(w);
    }
  }

  local_id which_goes(local_id a, local_id b) {
    if (is_fixed(a) || is_fixed(b))
      return is_fixed(a) ? b : a;
    const auto seen = [&](local_id side) {
      const auto [e, f] = elements_.elements(side); // not in one super-element yet
      return dihedral_side{side, judged_.quality[side], supers_.weight(e) + supers_.weight(f)};
    };
    return rule_.prefer_removal(seen(a), seen(b)) ? a : b;
  }

  void remove_or_refuse(local_id side, const deficit& missed) {
    const auto [a, b] = elements_.elements(side);
    const bool already_one = supers_.find(a) == supers_.find(b);
    if (!already_one && supers_.weight(a) + supers_.weight(b) > bound_) {
      refuse(side, missed);
      return;
    }
    supers_.unite(a, b);
    remove(side);
  }

  void refuse(local_id side, const deficit& missed) {
    refused_side& refusal = refusals_[side];
    if (refusal.side == no_id || missed.fraction() < refusal.missed.fraction())
      refusal = {side, missed};
  }

  void remove(local_id side) {
    if (runs_.is_removed(side))
      return;
    runs_.remove(side, [&](dihedral_id name) {
      if (queue_is_open_ && is_small(runs_.angle(name)))
        queue_.emplace(runs_.angle(name), name);
    });
  }

  csr_graph contracted_graph(const simplification& out) const {
    std::vector<double> weights(static_cast<std::size_t>(out.super_count), 0.0);
    for (std::size_t e = 0; e < weights_.size(); ++e)
      weights[out.super_of_element[e]] += weights_[e];
    std::vector<weighted_edge> edges;
    edges.reserve(fixed_.size());
    for (std::size_t s = 0; s < fixed_.size(); ++s) {
      if (out.side_states[s] == side_state::removed)
        continue;
      const auto [a, b] = elements_.elements(static_cast<local_id>(s));
      if (b == no_id)
        continue;
      const refused_side& refusal = refusals_[s];
      const double factor = refusal.side == no_id ? 1.0 : penalty_of(refusal.missed);
      edges.push_back(
          {out.super_of_element[a], out.super_of_element[b], factor * side_weight(static_cast<local_id>(s))});
    }
    return make_csr_graph(std::move(weights), edges);
  }

  void summarize(simplification& out) const {
    const auto count = [&](side_state state) {
      return std::count(out.side_states.begin(), out.side_states.end(), state);
    };
    const auto& weights = out.graph.node_weights;
    out.summary.name = "simplification";
    out.summary.set(simplification_counts{
        .elements = weights_.size(),
        .super_elements = out.super_count,
        .kept_sides = count(side_state::kept),
        .removed_sides = count(side_state::removed),
        .refused_sides = count(side_state::refused),
        .fixed_sides = count(side_state::fixed),
        .forced_dihedrals = out.forced.size(),
        .weight_bound = bound_,
        .heaviest_super_element = weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end())});
  }

  const Elements& elements_;
  side_judgement judged_;
  const Rule& rule_;
  std::vector<double> weights_; ///< per element
  dihedral_runs<Sides> runs_;
  disjoint_sets supers_;
  std::vector<refused_side> refusals_; ///< per side; side == no_id where none
  std::vector<std::uint8_t> fixed_;    ///< per side
  double bound_;
  std::vector<forced_dihedral> forced_;
  dihedral_queue queue_;
  bool queue_is_open_ = false;              ///< before S2 the queue is not filled
  std::vector<dihedral_id> beside_refused_; ///< small ones that were left alone
  const progress& on_progress_;
  std::size_t steps_ = 0;
};

} // namespace detail

/// Contracts an element-dual graph as far as a rule wants it and the bound allows it. `judged` is what the
/// rule says about the sides. `coupled` sides go first, whatever their quality; fixed ones among them are
/// passed over.
///
/// Afterwards every dihedral under `judged.wanted_angle_deg`, measured across super-elements, lies between
/// two fixed sides or touches a refused one. Deterministic: ties break by side and dihedral number.
/// Complexity: n log n in the number of small dihedrals. Throws `usage_error` for weights and angles of the
/// graphs that are no numbers, for a wrong number of qualities, and for what a rule or a side's weight says
/// that is not a number or negative, `cancelled` when `on_progress` asks to stop.
/// \param elements the element-dual graph
/// \param sides the side-dual graph
/// \param judged qualities of sides, and what is wanted
/// \param rule which of two sides goes, and penalties
/// \param bound how heavy a super-element may become
/// \param coupled sides decided one dimension below
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <element_dual_graph Elements, side_dual_graph Sides, contraction_rule Rule>
simplification contract_bounded(const Elements& elements, const Sides& sides, side_judgement judged,
                                const Rule& rule, const contraction_bound& bound = {},
                                std::span<const coupled_side> coupled = {},
                                const progress& on_progress = {}) {
  detail::bounded_contraction<Elements, Sides, Rule> run(elements, sides, std::move(judged), rule, bound,
                                                         on_progress);
  run.contract_coupled_sides(coupled);
  run.contract_bad_shapes();
  run.delete_small_dihedrals();
  return run.result();
}

} // namespace dovetail
