/// @file
/// The simplification of a solid's coarse mesh: first its surface, then, coupled to it, its volume.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/simplification/simplify.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// The coupling from a surface (D = 2) to the volume it bounds (D = 3): what a rule makes of the removed and
/// refused surface edges. `quality` is the rule's judgement of the edges; `volume_point` gives the volume's
/// number of each surface point, empty when they are the same.
template <simplification_rule<3> Rule>
std::vector<coupled_ridge<3>> coupled_ridges(const side_table<2>& edges, const simplification& simplified,
                                             std::span<const double> quality, const Rule& rule,
                                             std::span<const local_id> volume_point = {}) {
  std::vector<coupled_ridge<3>> ridges;
  auto refused = simplified.refused.begin();
  for (std::size_t s = 0; s < edges.size(); ++s) {
    const side_state state = simplified.side_states[s];
    if (state != side_state::refused && state != side_state::removed)
      continue;
    const shortfall missed = state == side_state::refused ? (refused++)->missed : shortfall{};
    const auto decision = rule.couples({state, quality[s], missed});
    if (!decision)
      continue;
    coupled_ridge<3> ridge{edges.vertices[s], *decision};
    if (!volume_point.empty())
      for (local_id& v : ridge.vertices)
        v = volume_point[static_cast<std::size_t>(v)];
    ridges.push_back(ridge);
  }
  return ridges;
}

/// Both simplifications; the volume's is what the partition is made from.
struct coupled_simplification {
  simplification surface;
  simplification volume;
  report summary; ///< the two steps' reports are its children
};

/// What is given beside the two meshes; all but `curve_edges` may be empty.
struct coupled_constraints {
  std::span<const simplex<1>> curve_edges = {}; ///< surface edges on CAD curves, as surface points
  std::span<const local_id> volume_point = {};  ///< the volume's number of each surface point; empty: equal
  std::span<const double> element_weights = {}; ///< predicted final elements per tetrahedron; empty: 1
  mesh_state meshes_are = mesh_state::unknown;  ///< `valid`: `require_valid` has seen both
};

namespace detail {

/// Throws `usage_error` for a point of the surface that is none of the volume.
inline void require_surface_points(const coupled_constraints& given, const simplicial_mesh<2>& surface,
                                   const simplicial_mesh<3>& volume) {
  if (given.volume_point.empty())
    return;
  if (given.volume_point.size() != surface.points.size())
    throw usage_error("simplify_coupled: " + std::to_string(given.volume_point.size()) +
                      " points of the volume for " + std::to_string(surface.points.size()) +
                      " points of the surface; give one each or none");
  for (std::size_t v = 0; v < given.volume_point.size(); ++v)
    if (given.volume_point[v] < 0 || static_cast<std::size_t>(given.volume_point[v]) >= volume.points.size())
      throw usage_error("simplify_coupled: point " + std::to_string(v) + " of the surface is point " +
                        std::to_string(given.volume_point[v]) + " of the volume, which has " +
                        std::to_string(volume.points.size()));
}

} // namespace detail

/// Simplifies the surface, then the volume such that what the rule couples to removed and refused surface
/// edges is done: the paper's removes all interior faces at a removed edge and penalises those at a refused
/// one. `surface` consists of the boundary and the material faces of `volume`; `sides` is
/// `build_sides(volume)`. Throws what `simplify` throws.
template <class Rule>
  requires simplification_rule<Rule, 2> && simplification_rule<Rule, 3> coupled_simplification
  simplify_coupled(const simplicial_mesh<2>& surface, const simplicial_mesh<3>& volume,
                   const side_table<3>& sides, const Rule& rule, const coupled_constraints& given = {},
                   const contraction_bound& bound = {}, const progress& on_progress = {}) {
    const stopwatch time;
    coupled_simplification out;
    const side_table<2> edges = build_sides(surface);
    detail::require_valid_unless(given.meshes_are, volume, sides, "simplify_coupled");
    detail::require_surface_points(given, surface, volume);
    out.surface =
        simplify<2>(surface, edges, rule, {.fixed_sides = given.curve_edges, .mesh_is = given.meshes_are},
                    bound, on_progress);
    out.surface.summary.name = "surface";
    const side_judgement judged = rule(surface, edges);
    detail::require_one_each(judged, edges.size());
    const auto ridges = coupled_ridges(edges, out.surface, span_of(judged.quality), rule, given.volume_point);
    out.volume = simplify<3>(volume, sides, rule,
                             {.coupled_ridges = span_of(ridges),
                              .element_weights = given.element_weights,
                              .mesh_is = given.meshes_are},
                             bound, on_progress);
    out.volume.summary.name = "volume";
    out.summary.name = "simplification";
    out.summary.children = {out.surface.summary, out.volume.summary};
    out.summary.seconds = time.seconds();
    return out;
  }

} // namespace dovetail
