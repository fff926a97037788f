/// @file
/// The simplification of a solid's coarse mesh: first its surface, then, coupled to it, its volume.
#pragma once

#include "dovetail/simplification/simplify.hpp"

#include <span>
#include <utility>
#include <vector>

namespace dovetail {

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
inline coupled_simplification simplify_coupled(const simplicial_mesh<2>& surface,
                                               const simplicial_mesh<3>& volume, const side_table<3>& sides,
                                               const coupled_constraints& given,
                                               const simplify_parameters<2>& on_surface,
                                               const simplify_parameters<3>& in_volume) {
  const stopwatch time;
  coupled_simplification out;
  const side_table<2> edges = build_sides(surface);
  out.surface = simplify<2>(surface, edges, {.fixed_sides = given.curve_edges}, on_surface);
  out.surface.summary.name = "surface";
  const auto ridges = coupling(surface, edges, out.surface, on_surface, given.volume_point);
  out.volume = simplify<3>(
      volume, sides,
      {.coupled_ridges = std::span<const coupled_ridge<3>>(ridges), .element_weights = given.element_weights},
      in_volume);
  out.volume.summary.name = "volume";
  out.summary.name = "simplification";
  out.summary.children = {out.surface.summary, out.volume.summary};
  out.summary.seconds = time.seconds();
  return out;
}

} // namespace dovetail
