/// @file
/// The simplification of a solid's coarse mesh: first its surface, then, coupled to it, its volume.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/simplification/simplify.hpp"

#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// The coupling from a surface (D = 2) to the volume it bounds (D = 3): removed and refused surface edges.
/// `volume_point` gives the volume's number of each surface point; empty when they are the same.
inline std::vector<coupled_ridge<3>> coupling(const simplicial_mesh<2>& surface, const side_table<2>& edges,
                                              const simplification<2>& simplified,
                                              const simplify_parameters<2>& parameters,
                                              std::span<const local_id> volume_point = {}) {
  const std::vector<double> shapes = side_shapes(surface, edges);
  std::vector<coupled_ridge<3>> ridges;
  auto refused = simplified.refused.begin();
  for (std::size_t s = 0; s < edges.size(); ++s) {
    const bool is_refused = simplified.side_states[s] == side_state::refused;
    if (!is_refused && simplified.side_states[s] != side_state::removed)
      continue;
    coupled_ridge<3> ridge{edges.vertices[s], shapes[s], parameters.wedge_threshold_deg, is_refused};
    if (is_refused)
      ridge.angle_deg = (refused++)->angle_deg;
    if (!volume_point.empty())
      for (local_id& v : ridge.vertices)
        v = volume_point[static_cast<std::size_t>(v)];
    ridges.push_back(ridge);
  }
  return ridges;
}

/// Both simplifications; the volume's is what the partition is made from.
struct coupled_simplification {
  simplification<2> surface;
  simplification<3> volume;
  report summary; ///< the two steps' reports are its children
};

/// What is given beside the two meshes; all but `curve_edges` may be empty.
struct coupled_constraints {
  std::span<const simplex<1>> curve_edges = {}; ///< surface edges on CAD curves, as surface points
  std::span<const local_id> volume_point = {};  ///< the volume's number of each surface point; empty: equal
  std::span<const double> element_weights = {}; ///< predicted final elements per tetrahedron; empty: 1
};

/// Simplifies the surface (50 degrees), then the volume (30 degrees) such that all interior faces at a
/// removed surface edge are removed and those at a refused one are penalised. `surface` consists of the
/// boundary and the material faces of `volume`; `sides` is `build_sides(volume)`.
/// (A template, so that only who simplifies waits for its compilation.)
template <int D>
  requires(D == 3)
coupled_simplification simplify_coupled(const simplicial_mesh<D - 1>& surface,
                                        const simplicial_mesh<D>& volume, const side_table<D>& sides,
                                        const coupled_constraints& given,
                                        const simplify_parameters<D - 1>& on_surface,
                                        const simplify_parameters<D>& in_volume) {
  const stopwatch time;
  coupled_simplification out;
  const side_table<D - 1> edges = build_sides(surface);
  out.surface = simplify<D - 1>(surface, edges, {.fixed_sides = given.curve_edges}, on_surface);
  out.surface.summary.name = "surface";
  const auto ridges = coupling(surface, edges, out.surface, on_surface, given.volume_point);
  out.volume =
      simplify<D>(volume, sides,
                  {.coupled_ridges = span_of(ridges), .element_weights = given.element_weights}, in_volume);
  out.volume.summary.name = "volume";
  out.summary.name = "simplification";
  out.summary.children = {out.surface.summary, out.volume.summary};
  out.summary.seconds = time.seconds();
  return out;
}

} // namespace dovetail
