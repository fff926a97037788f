/// @file
/// The simplification of a solid's coarse mesh: first its surface, then, coupled to it, its volume.
#pragma once

#include "dovetail/simplification/simplify.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// The coupling from a surface (D = 2) to the volume it bounds (D = 3): what a rule makes of the removed and
/// refused surface edges. `volume_point` gives the volume's number of each surface point, empty when they are
/// the same.
template <simplification_rule<3> Rule>
std::vector<coupled_ridge<3>> coupled_ridges(const side_table<2>& edges, const simplification& simplified,
                                             const Rule& rule, std::span<const local_id> volume_point = {}) {
  std::vector<coupled_ridge<3>> ridges;
  auto refused = simplified.refused.begin();
  for (std::size_t s = 0; s < edges.size(); ++s) {
    const side_state state = simplified.side_states[s];
    if (state != side_state::refused && state != side_state::removed)
      continue;
    const deficit missed = state == side_state::refused ? (refused++)->missed : deficit{};
    const auto decision = rule.propagate({state, simplified.quality[s], missed});
    if (!decision)
      continue;
    coupled_ridge<3> ridge{edges.vertices[s], *decision};
    if (!volume_point.empty())
      for (local_id& v : ridge.vertices)
        v = volume_point[v];
    ridges.push_back(ridge);
  }
  return ridges;
}

/// Both simplifications; the volume's is what the partition is made from.
struct coupled_simplification {
  simplification surface; ///< of the surface
  simplification volume;  ///< of the volume, after the surface
  report summary;         ///< the two steps' reports are its children
};

namespace detail {

/// Throws `usage_error` for a point of the surface that is none of the volume.
void require_surface_points(std::span<const local_id> volume_point, const simplicial_mesh<2>& surface,
                            const simplicial_mesh<3>& volume);

} // namespace detail

/// Simplifies the surface, then the volume such that what the rule makes of removed and refused surface edges
/// is done: the paper's removes all interior faces at a removed edge and penalises those at a refused one.
/// The surface consists of the boundary and the material faces of the volume; `volume_point` gives the
/// volume's number of each of its points, empty when they are the same. Throws what `simplify` throws.
/// Complexity: that of `simplify`, twice.
/// \param surface the surface mesh with its fixed edges
/// \param volume the volume mesh, its sides and weights
/// \param rule which sides are to go, in either dimension
/// \param bound how heavy a super-element may become
/// \param volume_point one per point of the surface, or empty
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <class Rule>
  requires simplification_rule<Rule, 2> && simplification_rule<Rule, 3>
      coupled_simplification simplify_coupled(const mesh_duals<2>& surface, const mesh_duals<3>& volume,
                                              const Rule& rule, const contraction_bound& bound = {},
                                              std::span<const local_id> volume_point = {},
                                              const progress& on_progress = {}) {
    const stopwatch time;
    coupled_simplification out;
    detail::require_surface_points(volume_point, surface.mesh(), volume.mesh());
    out.surface = simplify<2>(surface.mesh(), surface, rule, bound, {}, on_progress);
    out.surface.summary.name = "surface";
    const auto ridges = coupled_ridges(surface.sides(), out.surface, rule, volume_point);
    out.volume = simplify<3>(volume.mesh(), volume, rule, bound, span_of(ridges), on_progress);
    out.volume.summary.name = "volume";
    out.summary.name = "simplification";
    out.summary.children = {out.surface.summary, out.volume.summary};
    out.summary.seconds = time.seconds();
    return out;
  }

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/simplification/simplify_coupled.ipp"
#endif
