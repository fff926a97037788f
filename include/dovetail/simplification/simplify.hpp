/// @file
/// Mesh simplification: contract elements across all sides that may not become an interface.
///
/// Section 3.3 of J. Chen et al., "Scalable generation of large-scale unstructured meshes by a novel domain
/// decomposition approach", for D = 2 and D = 3 by one template: coupled sides (S0), sides of bad shape (S1),
/// then node deletion on the side-dual graph, smallest wedge first (S2). All contractions are bounded: one
/// that would make a super-element too heavy is refused, and the side gets a large weight in the contracted
/// graph instead, so that the partitioner avoids it.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/mesh/wedge_runs.hpp"
#include "dovetail/simplification/side_shape.hpp"
#include "dovetail/simplification/types.hpp"

#include <algorithm>
#include <array>
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

/// One run of the algorithm; `simplify` calls its steps in order.
template <int D>
class simplifier {
public:
  simplifier(const simplicial_mesh<D>& mesh, const side_table<D>& sides, const simplify_constraints<D>& given,
             const simplify_parameters<D>& parameters)
      : mesh_(mesh), sides_(sides), given_(given), parameters_(parameters), shapes_(side_shapes(mesh, sides)),
        runs_(mesh, sides), supers_(element_weights()), refusals_(sides.size()), fixed_(sides.size(), 0) {
    const double total = std::accumulate(given_.element_weights.begin(), given_.element_weights.end(), 0.0);
    const auto n = static_cast<double>(mesh.elements.size());
    const double weight = given_.element_weights.empty() ? n : total;
    bound_ = std::max(parameters.bound_fraction * weight / std::max(1.0, parameters.subdomains),
                      n > 0 ? parameters.always_allowed_elements * weight / n : 0.0);
    mark_fixed();
  }

  void contract_coupled_sides() {
    std::vector<candidate> candidates = sides_at_coupled_ridges();
    contract_worst_first(candidates);
  }

  void contract_bad_shapes() {
    std::vector<candidate> candidates;
    for (std::size_t s = 0; s < sides_.size(); ++s)
      if (shapes_[s] < parameters_.shape_threshold_deg && fixed_[s] == 0)
        candidates.push_back({shapes_[s], parameters_.shape_threshold_deg, static_cast<local_id>(s), false});
    contract_worst_first(candidates);
  }

  void delete_small_wedges() {
    std::vector<queued_wedge> first;
    for (std::uint32_t w = 0; w < runs_.wedge_count(); ++w)
      if (runs_.is_name(w) && is_small(runs_.angle(w)))
        first.push_back({runs_.angle(w), w});
    queue_ = wedge_queue(std::greater<>(), std::move(first));
    queue_is_open_ = true;
    while (!queue_.empty()) {
      const auto [angle, w] = queue_.top();
      queue_.pop();
      if (runs_.is_end(w) && runs_.angle(w) == angle) // else an older state of a run that has grown
        treat_wedge(w, angle);
    }
  }

  simplification<D> result() {
    simplification<D> out;
    out.side_states.resize(sides_.size());
    auto numbered = supers_.number_sets();
    out.super_of_element = std::move(numbered.of_member);
    out.super_count = numbered.count;
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      const auto side = static_cast<local_id>(s);
      if (fixed_[s] != 0) {
        out.side_states[s] = side_state::fixed;
      } else if (is_internal(side)) {
        out.side_states[s] = side_state::removed;
      } else if (refusals_[s].side != no_id) {
        out.side_states[s] = side_state::refused;
        out.refused.push_back(refusals_[s]);
      }
    }
    out.forced = std::move(forced_);
    out.graph = contracted_graph(out);
    summarize(out);
    return out;
  }

private:
  struct candidate {
    double angle;
    double threshold;
    local_id side;
    bool only_penalise;

    auto key() const { return std::tuple(angle - threshold, side, only_penalise); }
  };
  using queued_wedge = std::pair<double, std::uint32_t>; ///< ties by wedge number
  using wedge_queue = std::priority_queue<queued_wedge, std::vector<queued_wedge>, std::greater<>>;

  std::vector<double> element_weights() const {
    if (given_.element_weights.empty())
      return std::vector<double>(mesh_.elements.size(), 1.0);
    if (given_.element_weights.size() != mesh_.elements.size())
      throw usage_error("simplify: " + std::to_string(given_.element_weights.size()) +
                        " element weights for " + std::to_string(mesh_.elements.size()) +
                        " elements; give one each or none");
    return {given_.element_weights.begin(), given_.element_weights.end()};
  }

  void mark_fixed() {
    std::vector<simplex<D - 1>> given;
    given.reserve(given_.fixed_sides.size());
    for (const auto& vertices : given_.fixed_sides)
      given.push_back(sorted_vertices(vertices));
    sort_all(given);
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      const bool listed = !given.empty() &&
                          std::binary_search(given.begin(), given.end(), sorted_vertices(sides_.vertices[s]));
      fixed_[s] = listed || !sides_.is_interior(static_cast<local_id>(s)) || changes_tag(s) ? 1 : 0;
    }
  }

  bool changes_tag(std::size_t side) const {
    if (mesh_.tags.empty())
      return false;
    const auto [a, b] = sides_.elements[side];
    return mesh_.tags[static_cast<std::size_t>(a)] != mesh_.tags[static_cast<std::size_t>(b)];
  }

  bool is_fixed(local_id side) const { return fixed_[static_cast<std::size_t>(side)] != 0; }
  bool is_refused(local_id side) const { return refusals_[static_cast<std::size_t>(side)].side != no_id; }
  bool is_small(double angle) const { return angle < parameters_.wedge_threshold_deg; }
  /// Both elements are in one super-element, so the side can never become an interface.
  bool is_internal(local_id side) {
    const auto [a, b] = sides_.elements[static_cast<std::size_t>(side)];
    return !is_fixed(side) && supers_.find(a) == supers_.find(b);
  }

  std::vector<candidate> sides_at_coupled_ridges() const {
    std::vector<coupled_ridge<D>> ridges(given_.coupled_ridges.begin(), given_.coupled_ridges.end());
    for (auto& ridge : ridges)
      ridge.vertices = sorted_vertices(ridge.vertices);
    const auto by_vertices = [](const auto& a, const auto& b) { return a.vertices < b.vertices; };
    sort_all(ridges, by_vertices);
    std::vector<candidate> candidates;
    if (ridges.empty())
      return candidates;
    std::vector<bool> is_end(mesh_.points.size(), false);
    for (const auto& ridge : ridges)
      for (const local_id v : ridge.vertices)
        is_end[static_cast<std::size_t>(v)] = true;
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      if (fixed_[s] != 0)
        continue;
      for (const auto& local : numbering::sides<D - 1>) { // the ridges of a side are the sides of a side
        const auto vertices = sorted_vertices(pick(sides_.vertices[s], local));
        if (!std::all_of(vertices.begin(), vertices.end(),
                         [&](local_id v) { return is_end[static_cast<std::size_t>(v)]; }))
          continue;
        const auto found =
            std::lower_bound(ridges.begin(), ridges.end(), coupled_ridge<D>{vertices}, by_vertices);
        if (found != ridges.end() && found->vertices == vertices)
          candidates.push_back(
              {found->angle_deg, found->threshold_deg, static_cast<local_id>(s), found->refused});
      }
    }
    return candidates;
  }

  void contract_worst_first(std::vector<candidate>& candidates) {
    sort_all(candidates, [](const candidate& a, const candidate& b) { return a.key() < b.key(); });
    for (const candidate& c : candidates)
      if (c.only_penalise)
        refuse(c.side, c.angle, c.threshold);
      else
        remove_or_refuse(c.side, c.angle, c.threshold);
  }

  void treat_wedge(std::uint32_t w, double angle) {
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
    if (is_refused(a) || is_refused(b))
      return;
    remove_or_refuse(worse_of(a, b), angle, parameters_.wedge_threshold_deg);
  }

  /// The non-fixed side with the worse own shape; ties by key.
  local_id worse_of(local_id a, local_id b) const {
    if (is_fixed(a) || is_fixed(b))
      return is_fixed(a) ? b : a;
    const auto key = [&](local_id side) { return std::pair(shapes_[static_cast<std::size_t>(side)], side); };
    return key(a) < key(b) ? a : b;
  }

  void remove_or_refuse(local_id side, double angle, double threshold) {
    const auto [a, b] = sides_.elements[static_cast<std::size_t>(side)];
    const bool already_one = supers_.find(a) == supers_.find(b);
    if (!already_one && supers_.weight(a) + supers_.weight(b) > bound_) {
      refuse(side, angle, threshold);
      return;
    }
    supers_.unite(a, b);
    remove(side);
  }

  void refuse(local_id side, double angle, double threshold) {
    refused_side& refusal = refusals_[static_cast<std::size_t>(side)];
    const bool is_worse =
        refusal.side == no_id || angle / threshold < refusal.angle_deg / refusal.threshold_deg;
    if (is_worse)
      refusal = {side, angle, threshold};
  }

  void remove(local_id side) {
    if (runs_.is_removed(side))
      return;
    runs_.remove(side, [&](std::uint32_t name) {
      if (queue_is_open_ && is_small(runs_.angle(name)))
        queue_.emplace(runs_.angle(name), name);
    });
  }

  double edge_weight(std::size_t side) const {
    const refused_side& refusal = refusals_[side];
    if (refusal.side == no_id)
      return 1;
    return 1 + parameters_.refusal_price +
           parameters_.refusal_penalty * std::max(0.0, 1 - refusal.angle_deg / refusal.threshold_deg);
  }

  csr_graph contracted_graph(const simplification<D>& out) {
    std::vector<double> weights(static_cast<std::size_t>(out.super_count), 0.0);
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
      weights[static_cast<std::size_t>(out.super_of_element[e])] +=
          given_.element_weights.empty() ? 1.0 : given_.element_weights[e];
    std::vector<weighted_edge> edges;
    for (std::size_t s = 0; s < sides_.size(); ++s)
      if (sides_.is_interior(static_cast<local_id>(s)) && out.side_states[s] != side_state::removed) {
        const auto [a, b] = sides_.elements[s];
        edges.push_back({out.super_of_element[static_cast<std::size_t>(a)],
                         out.super_of_element[static_cast<std::size_t>(b)], edge_weight(s)});
      }
    return make_csr_graph(std::move(weights), edges);
  }

  void summarize(simplification<D>& out) const {
    const auto count = [&](side_state state) {
      return static_cast<double>(std::count(out.side_states.begin(), out.side_states.end(), state));
    };
    report& summary = out.summary;
    summary.name = "simplification";
    summary.set("elements", static_cast<double>(mesh_.elements.size()));
    summary.set("super_elements", static_cast<double>(out.super_count));
    summary.set("kept_sides", count(side_state::kept));
    summary.set("removed_sides", count(side_state::removed));
    summary.set("refused_sides", count(side_state::refused));
    summary.set("fixed_sides", count(side_state::fixed));
    summary.set("forced_wedges", static_cast<double>(out.forced.size()));
    summary.set("weight_bound", bound_);
    const auto& weights = out.graph.node_weights;
    summary.set("heaviest_super_element",
                weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end()));
  }

  const simplicial_mesh<D>& mesh_;
  const side_table<D>& sides_;
  const simplify_constraints<D>& given_;
  const simplify_parameters<D>& parameters_;
  std::vector<double> shapes_;
  wedge_runs<D> runs_;
  disjoint_sets supers_;
  std::vector<refused_side> refusals_; ///< per side; side == no_id where none
  std::vector<std::uint8_t> fixed_;    ///< per side
  std::vector<forced_wedge> forced_;
  wedge_queue queue_;
  bool queue_is_open_ = false; ///< before S2 the queue is not filled
  double bound_ = 0;
};

} // namespace detail

/// Simplifies a mesh. `sides` is `build_sides(mesh)`. Sides between elements of different tags are fixed.
///
/// Afterwards every wedge under the threshold, measured across super-elements, lies between two fixed sides
/// or touches a refused one. Deterministic: ties break by side and wedge number. Complexity: n log n in the
/// number of small wedges. Throws `usage_error` for a wrong number of weights.
template <int D>
simplification<D> simplify(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                           const simplify_constraints<D>& constraints = {},
                           const simplify_parameters<D>& parameters = {}) {
  const stopwatch time;
  detail::simplifier<D> run(mesh, sides, constraints, parameters);
  run.contract_coupled_sides();
  run.contract_bad_shapes();
  run.delete_small_wedges();
  simplification<D> out = run.result();
  out.summary.seconds = time.seconds();
  return out;
}

} // namespace dovetail
