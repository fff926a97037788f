/// @file
/// The patch remesher: fills frozen boundary loops on a parametric surface with well-shaped triangles of the
/// size a sizing field asks for.
///
/// The triangulation is valid in the parameter plane at every step. It starts from the constrained Delaunay
/// triangulation of the loops, is filled from the boundary inwards, and is then improved by collapses,
/// splits, flips and smoothing, all measured in 3-space.
#pragma once

#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/sizing/concepts.hpp"

namespace dovetail {

/// What the remesher of patches counts.
struct remeshed_counts {
  std::size_t triangles = 0;       ///< how many there are
  double min_angle_deg = 0;        ///< the smallest of all
  double mean_min_angle_deg = 0;   ///< of the smallest angles of triangles
  std::size_t below_30_deg = 0;    ///< triangles with a smaller angle
  double mean_relative_length = 0; ///< of edges, in units of the size
  std::size_t folded = 0;          ///< triangles turned over

  using fields = field_list<&remeshed_counts::triangles, &remeshed_counts::min_angle_deg,
                            &remeshed_counts::mean_min_angle_deg, &remeshed_counts::below_30_deg,
                            &remeshed_counts::mean_relative_length, &remeshed_counts::folded>;
};

} // namespace dovetail

namespace dovetail::remesh {

/// Parameters and call of the patch remesher; a policy in the sense of the other roles.
struct patch_remesher {
  double size_growth = 0.35; ///< largest change of edge length per unit of distance from the boundary
  double short_edge = 0.60;  ///< edges below this times the size are collapsed
  double long_edge = 1.50;   ///< inner edges above this times the size are split
  int cycles = 3;            ///< rounds of collapses, splits, flips and smoothing
  int smoothing_passes = 3;  ///< smoothing passes in a round
  int repair_rounds = 4;     ///< rounds that only work on triangles below 30 degrees

  /// Meshes one patch. Complexity: about linear in the number of triangles made. Never throws on bad loops:
  /// see `patch_mesh::ok`; passes on what the surface and the sizing field throw.
  /// The work is compiled for planes and for other surfaces.
  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& sizing) const;
  template <patch_surface Surface>
  patch_mesh operator()(const Surface& surface, const patch_boundary& boundary,
                        const any_sizing& sizing) const {
    return (*this)(any_surface::view_of(surface), boundary, sizing);
  }
};

} // namespace dovetail::remesh

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/patch_remesher.ipp"
#endif
