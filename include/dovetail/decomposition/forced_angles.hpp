/// @file
/// Which small interface angles the CAD itself forces: no interface that ends there can have a larger one.
#pragma once

#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <array>
#include <span>

namespace dovetail {

/// The CAD as a mesh sees it: triangles on its faces, oriented outwards, and edges on its curves.
struct cad_mesh {
  std::span<const vec3> points;                    ///< of the mesh
  std::span<const simplex<2>> triangles;           ///< on CAD faces, oriented outwards
  std::span<const local_id> faces;                 ///< per triangle: its CAD face, or no_id inside the domain
  std::span<const std::array<local_id, 2>> beside; ///< per triangle: what is behind and in front, or no_id
  std::span<const simplex<1>> curve_edges;         ///< on CAD curves
  std::span<const local_id> curves;                ///< per edge
};

/// The CAD as the triangles and edges of a fine skeleton show it.
inline cad_mesh cad_of(const fine_skeleton& fine) {
  return {fine.points, fine.sides, fine.side_hosts, fine.subdomains, fine.curve_edges, fine.curves};
}

/// Names the CAD entities at each small angle of D = 3, and those that force it, whose cause becomes
/// `forced`: two faces that meet at less than is wanted, at an edge that begins where the angle is; for the
/// angle of a triangle also two curves that do so at its corner, and a curve or the width of a face that is
/// so short that a triangle of the local size with that as its shortest side has no larger angle.
/// `triangles` are those that were measured. Without small angles nothing is done; else O(n log n) in points,
/// triangles, curve edges and small angles, as long as the curve edges at a point are few.
void find_forced(interface_angles& angles, std::span<const simplex<2>> triangles, const cad_mesh& cad,
                 const any_sizing& size, const wanted_angles& wanted);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/forced_angles.ipp"
#endif
