/// @file
/// What `divide` does differently in D = 2 and D = 3.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/forced_angles.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/simplification/concepts.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"

#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

inline std::span<const local_id> materials_of(const simplicial_background<3>& mesh) {
  return mesh.volume.tags;
}
/// None: in D = 2 nothing is cut by material.
inline std::span<const local_id> materials_of(const simplicial_background<2>&) {
  return {};
}

inline std::vector<simplex<1>> edges_on_curves(const surface_mesh& surface) {
  std::vector<simplex<1>> edges;
  for (const auto& edge : surface.curve_edges)
    edges.push_back(edge.vertices);
  return edges;
}

/// The simplification of a background mesh; in D = 3 that of its surface goes before.
template <int D, class Rule>
  requires simplification_rule<Rule, 2> && simplification_rule<Rule, D>
      simplification simplify_background(const simplicial_background<D>& mesh, const side_table<D>& sides,
                                         std::span<const double> weights, const contraction_bound& bound,
                                         const Rule& rule, report& summary, const progress& on_progress) {
    const auto on_curves = edges_on_curves(mesh.surface);
    const auto& surface = mesh.surface.mesh;
    if constexpr (D == 2) {
      const mesh_duals<2> duals(surface, sides, {span_of(on_curves), weights, mesh_state::valid});
      auto simplified = simplify<2>(surface, duals, rule, bound, {}, on_progress);
      summary = simplified.summary;
      return simplified;
    } else {
      auto coupled =
          simplify_coupled({surface, {.fixed_sides = span_of(on_curves), .mesh_is = mesh_state::valid}},
                           {mesh.volume, sides, {.element_weights = weights, .mesh_is = mesh_state::valid}},
                           rule, bound, {}, on_progress);
      summary = std::move(coupled.summary);
      return std::move(coupled.volume);
    }
  }

/// Measured through the elements. In D = 3 the CAD entities are found that force an angle.
template <int D>
interface_angles coarse_interface_angles(const simplicial_background<D>& mesh, const side_table<D>& sides,
                                         std::span<const side_state> side_states,
                                         std::span<const local_id> subdomain_of_element,
                                         const any_sizing& size, const wanted_angles& wanted) {
  auto angles = measure_interface_angles<D>(
      {mesh.elements(), sides, side_states, subdomain_of_element, {}, mesh_state::valid}, wanted);
  if constexpr (D == 3)
    if (!angles.violations.empty()) {
      const auto beside = elements_beside_surface(mesh, sides);
      const auto on_curves = edges_on_curves(mesh.surface);
      std::vector<local_id> curves;
      for (const auto& edge : mesh.surface.curve_edges)
        curves.push_back(edge.curve);
      find_forced(
          angles, sides.vertices,
          {mesh.volume.points, mesh.surface.mesh.elements, mesh.surface.mesh.tags, beside, on_curves, curves},
          size, wanted);
    }
  return angles;
}

} // namespace dovetail::detail
