/// @file
/// Mesh simplification: the bounded contraction on the dual graphs of a mesh, by any rule.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/simplification/bounded_contraction.hpp"
#include "dovetail/simplification/mesh_duals.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

namespace detail {

/// Not zero for the given sides, and for those between elements of different tags.
template <int D>
std::vector<std::uint8_t> fixed_inside(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                       std::span<const simplex<D - 1>> fixed_sides) {
  std::vector<simplex<D - 1>> given;
  given.reserve(fixed_sides.size());
  for (const auto& vertices : fixed_sides)
    given.push_back(sorted_vertices(vertices));
  sort_all(given);
  const auto changes_tag = [&](std::size_t side) {
    const auto [a, b] = sides.elements[side];
    return !mesh.tags.empty() && b != no_id &&
           mesh.tags[static_cast<std::size_t>(a)] != mesh.tags[static_cast<std::size_t>(b)];
  };
  std::vector<std::uint8_t> fixed(sides.size(), 0);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const bool listed =
        !given.empty() && std::binary_search(given.begin(), given.end(), sorted_vertices(sides.vertices[s]));
    fixed[s] = listed || changes_tag(s) ? 1 : 0;
  }
  return fixed;
}

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
      is_end[static_cast<std::size_t>(v)] = true;
  }
  const auto by_vertices = [](const auto& a, const auto& b) { return a.vertices < b.vertices; };
  sort_all(ridges, by_vertices);
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (const auto& local : numbering::sides<D - 1>) { // the ridges of a side are the sides of a side
      const auto vertices = sorted_vertices(pick(sides.vertices[s], local));
      if (!std::all_of(vertices.begin(), vertices.end(),
                       [&](local_id v) { return is_end[static_cast<std::size_t>(v)]; }))
        continue;
      const auto ridge =
          std::lower_bound(ridges.begin(), ridges.end(), coupled_ridge<D>{vertices, {}}, by_vertices);
      if (ridge != ridges.end() && ridge->vertices == vertices)
        found.push_back({static_cast<local_id>(s), ridge->decision});
    }
  return found;
}

} // namespace detail

/// Simplifies a mesh by a rule. `sides` is `build_sides(mesh)`. Sides between elements of different tags are
/// fixed. For the rest see `contract_bounded`. Throws `mesh_error` when `require_valid` refuses the mesh,
/// which takes about a tenth of the time, and `usage_error` for a wrong number of weights.
template <int D, simplification_rule<D> Rule>
simplification simplify(const simplicial_mesh<D>& mesh, const side_table<D>& sides, const Rule& rule,
                        const simplify_constraints<D>& given = {}, const contraction_bound& bound = {},
                        const progress& on_progress = {}) {
  const stopwatch time;
  if (!given.element_weights.empty() && given.element_weights.size() != mesh.elements.size())
    throw usage_error("simplify: " + std::to_string(given.element_weights.size()) + " element weights for " +
                      std::to_string(mesh.elements.size()) + " elements; give one each or none");
  on_progress.stop_if_requested();
  detail::require_valid_unless(given.mesh_is, mesh, sides, "simplify");
  const auto fixed = detail::fixed_inside(mesh, sides, given.fixed_sides);
  const auto coupled = detail::sides_at_ridges<D>(sides, mesh.points.size(), given.coupled_ridges);
  simplification out = contract_bounded(element_dual<D>(sides, given.element_weights, span_of(fixed)),
                                        side_dual<D>(mesh, sides, mesh_state::valid), rule(mesh, sides), rule,
                                        bound, span_of(coupled), on_progress);
  out.summary.seconds = time.seconds();
  return out;
}

} // namespace dovetail
