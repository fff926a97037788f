/// @file
/// The stage of simplification: the bounded contraction of the dual graphs of a mesh, or of any graph, by any
/// rule.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/simplification/bounded_contraction.hpp"
#include "dovetail/simplification/graph_dual.hpp"
#include "dovetail/simplification/mesh_duals.hpp"
#ifdef DOVETAIL_COMPILED
#include "dovetail/simplification/paper.hpp"
#endif

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

namespace detail {

/// All sides at coupled ridges.
template <int D>
std::vector<coupled_side> sides_at_ridges(const side_table<D>& sides, std::size_t point_count,
                                          std::span<const coupled_ridge<D>> coupled) {
  std::vector<coupled_side> found;
  if (coupled.empty())
    return found;
  std::vector<coupled_ridge<D>> ridges(coupled.begin(), coupled.end());
  std::vector<bool> is_end(point_count, false);
  for (auto& ridge : ridges) {
    ridge.vertices = sorted_vertices(ridge.vertices);
    for (const local_id v : ridge.vertices)
      is_end[v] = true;
  }
  const auto by_vertices = [](const auto& a, const auto& b) { return a.vertices < b.vertices; };
  sort_all(ridges, by_vertices);
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (const auto& local : numbering::sides<D - 1>) { // the ridges of a side are the sides of a side
      const auto vertices = sorted_vertices(pick(sides.vertices[s], local));
      if (!std::all_of(vertices.begin(), vertices.end(), [&](local_id v) { return is_end[v]; }))
        continue;
      const auto ridge =
          std::lower_bound(ridges.begin(), ridges.end(), coupled_ridge<D>{vertices, {}}, by_vertices);
      if (ridge != ridges.end() && ridge->vertices == vertices)
        found.push_back({static_cast<local_id>(s), ridge->decision});
    }
  return found;
}

} // namespace detail

/// The simplification (paper, section 3.3): which sides of a mesh are to become no interfaces, and the
/// element-dual graph contracted across them, as a partitioner takes it. `coupled` is what was decided one
/// dimension below. For the rest see `contract_bounded`; the rule is bound at compile time down to its call
/// in there.
/// Complexity: n log n in the number of small dihedrals. Throws what `contract_bounded` throws.
/// \param mesh triangles (D = 2) or tetrahedra (D = 3)
/// \param duals the mesh's dual graphs, their weights and fixed sides
/// \param rule which sides are to go
/// \param bound how heavy a super-element may become
/// \param coupled sides that go, or are penalised, since those of the surface do
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <int D, simplification_rule<D> Rule>
simplification simplify(const simplicial_mesh<D>& mesh, const mesh_duals<D>& duals, const Rule& rule,
                        const contraction_bound& bound = {}, std::span<const coupled_ridge<D>> coupled = {},
                        const progress& on_progress = {}) {
  const stopwatch time;
  on_progress.stop_if_requested();
  const auto coupled_sides = detail::sides_at_ridges<D>(duals.sides(), mesh.points.size(), coupled);
  simplification out = contract_bounded(duals.elements(), duals.dihedrals(), rule(mesh, duals.sides()), rule,
                                        bound, span_of(coupled_sides), on_progress);
  out.summary.seconds = time.seconds();
  return out;
}

/// The same for any graph. The rule judges its edges: `rule(graph, duals)` has one quality per edge of
/// `duals`, which is `graph_dual(graph)`.
/// \param graph any graph, whose edges take the place of sides
template <weighted_graph G, contraction_rule Rule>
  requires requires(const G& graph, const graph_dual& duals, const Rule& rule) {
    { rule(graph, duals) } -> std::same_as<side_judgement>;
  }
simplification simplify(const G& graph, const graph_dual& duals, const Rule& rule,
                        const contraction_bound& bound = {}, const progress& on_progress = {}) {
  const stopwatch time;
  on_progress.stop_if_requested();
  simplification out = contract_bounded(duals, duals, rule(graph, duals), rule, bound, {}, on_progress);
  out.summary.seconds = time.seconds();
  return out;
}

#ifdef DOVETAIL_COMPILED
// By the default rule.
extern template simplification simplify<2>(const simplicial_mesh<2>& mesh, const mesh_duals<2>& duals,
                                           const simplifier::paper& rule, const contraction_bound& bound,
                                           std::span<const coupled_ridge<2>> coupled,
                                           const progress& on_progress);
extern template simplification simplify<3>(const simplicial_mesh<3>& mesh, const mesh_duals<3>& duals,
                                           const simplifier::paper& rule, const contraction_bound& bound,
                                           std::span<const coupled_ridge<3>> coupled,
                                           const progress& on_progress);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/simplification/simplify.ipp"
#endif
