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

/// What is counted of a bisection.
struct bisection_counts {
  std::size_t subdomains = 0;      ///< in the end
  std::size_t cuts = 0;            ///< that were made
  std::size_t planes = 0;          ///< tried; those of them that failed follow
  std::size_t without_loops = 0;   ///< no simple loops lie in the plane
  std::size_t uneven = 0;          ///< one side has too few faces
  std::size_t unspanned = 0;       ///< the loops could not be spanned
  std::size_t crossing = 0;        ///< the interface crosses the boundary
  std::size_t too_sharp = 0;       ///< no better than the least dihedral, or than another plane
  std::size_t whole = 0;           ///< subdomains with more than `most_faces` that no plane divides
  std::size_t most_faces = 0;      ///< of a subdomain
  std::size_t interface_faces = 0; ///< triangles of the cuts
  double least_dihedral_deg = 0;   ///< at a loop

  using fields =
      field_list<&bisection_counts::subdomains, &bisection_counts::cuts, &bisection_counts::planes,
                 &bisection_counts::without_loops, &bisection_counts::uneven, &bisection_counts::unspanned,
                 &bisection_counts::crossing, &bisection_counts::too_sharp, &bisection_counts::whole,
                 &bisection_counts::most_faces, &bisection_counts::interface_faces,
                 &bisection_counts::least_dihedral_deg>;
};

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
/// The summary has `bisection_counts`.
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
