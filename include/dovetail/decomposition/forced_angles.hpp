/// @file
/// Which small interface angles the CAD itself forces: no interface that ends there can have a larger one.
#pragma once

#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <span>

namespace dovetail {

/// The CAD as a mesh sees it: triangles on its faces, oriented outwards, and edges on its curves.
struct cad_mesh {
  std::span<const vec3> points;
  std::span<const simplex<2>> triangles;
  std::span<const local_id> faces; ///< per triangle: its CAD face, or no_id inside the domain
  std::span<const simplex<1>> curve_edges;
  std::span<const local_id> curves; ///< per edge
};

/// Names the CAD entities at each violation, and those that force it, whose cause becomes `forced`: two faces
/// that meet at a smaller angle than the threshold at an edge that begins where the violation is; for the
/// angle of a triangle also two curves that do so at its corner, and a curve or the width of a face so short
/// that on it as its shortest side no triangle of the local size has a larger angle. `triangles` are those
/// that were measured. Without violations nothing is done; else O(n log n) in points, triangles, curve edges
/// and violations, as long as the curve edges at a point are few.
void find_forced(interface_angles& angles, std::span<const simplex<2>> triangles, const cad_mesh& cad,
                 const any_sizing& size, double threshold_deg);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/forced_angles.ipp"
#endif
