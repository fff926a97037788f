/// @file
/// Algorithm 2 of the paper (section 5.2; its references [9, 15, 16]): domain decomposition by recursive
/// bi-division of the fine surface triangulation.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::baselines {

/// Subdomains whose boundaries are as fine as the mesh.
struct bisected_surface {
  fine_skeleton fine;                          ///< the subdomains' boundaries
  std::vector<local_id> material_of_subdomain; ///< a material for each subdomain
  report summary;                              ///< what was counted on the way
};

/// Divides solids, given by their fine surface, until each subdomain has few faces, the largest first. A
/// subdomain is cut in two:
///
/// 1. by a plane across its longest axis that has about half of its triangles on each side; the loops of
///    surface edges between them are smoothed;
/// 2. an inter-domain triangulation in the sizes of the mesh spans the loops: made in the plane, then
///    lifted inside to where the loops are;
/// 3. it must stay inside the subdomain, cross none of its triangles, and make no dihedral with them that is
///    smaller than need be.
///
/// Where one of these fails, or a dihedral is under `good_dihedral_deg`, other planes are tried, and the best
/// of them is taken. Where none will do the subdomain stays whole.
///
/// It is sequential, as in the paper: the first cut is one task, and it takes all of the surface.
///
/// Called with a skeleton of one subdomain for each solid, as `decomposition_rounds` makes it of a model
/// that is not divided. Throws what the surface mesher and the field throw, and `cancelled`. About
/// O(n log n) in the faces for each level of the recursion and each plane tried.
///
/// The summary counts "subdomains", "cuts", "planes" (tried), those of them that failed ("without_loops",
/// "uneven", "unspanned", "crossing", and "too_sharp": no better than `least_dihedral_deg`, or than another),
/// "whole" (subdomains with more than `most_faces` that no plane divides), "most_faces" and
/// "interface_faces"; "least_dihedral_deg" is the smallest at a loop.
struct recursive_bisection {
  std::size_t most_faces = 20000;         ///< of a subdomain's boundary
  std::size_t most_subdomains = 0;        ///< no more cuts are made when there are so many; 0: any number
  double good_dihedral_deg = 30;          ///< no other plane is tried where the least dihedral is this
  double least_dihedral_deg = 8;          ///< a cut with a smaller one is none
  double least_share = 0.1;               ///< of the faces, on either side of a cut
  any_surface_mesher mesh_interface = {}; ///< makes the triangles of an interface
  progress on_progress = {};              ///< of the subdomains that there are

  /// Divides the bodies that `surface` bounds.
  bisected_surface operator()(fine_skeleton surface, std::vector<local_id> material_of_subdomain,
                              const any_sizing& size) const;
};

} // namespace dovetail::baselines

#ifndef DOVETAIL_COMPILED
#include "dovetail/experiments/baselines/recursive_bisection.ipp"
#endif
