/// @file
/// CGAL's Mesh_3: Delaunay refinement of a whole domain, which makes a surface of its own. Header-only,
/// parsing this file takes some 20 s and 2 GB: include it where the mesher is chosen and nowhere else.
#pragma once

#include "dovetail/mesher/concepts.hpp"

#include <utility>
#include <vector>

namespace dovetail::mesher {

/// A model of `piece_mesher<3>`, and of `line_keeping_mesher`, that is no `boundary_keeping_mesher<3>`: the
/// triangles given are the shape of the domain, and neither they nor their points are in the result. Its
/// ridges are kept as lines. Slivers are left to an improver.
///
/// So it meshes whole bodies and never subdomains, whose meshes would not match. Shells must be manifold.
/// Complexity: about n log n in the elements made, plus an inside test by a ray for each facet and cell.
struct cgal_mesh_3 {
  static constexpr mesher_traits traits{.keeps_boundary = false,
                                        .thread_safe = true,
                                        .accepts_non_manifold = false,
                                        .repeats_in_process = true,
                                        .may_crash = false};

  double feature_angle_deg = 50;   ///< edges where the normal turns by more are kept as lines
  double surface_distance = 0.05;  ///< largest distance of a facet's centre from the domain, times the size
  double radius_edge_ratio = 2.0;  ///< upper bound for the elements
  double facet_angle_deg = 25;     ///< lower bound for angles of boundary triangles; up to 30
  double size_scale = 1.0;         ///< multiplies the field
  double call_budget_factor = 400; ///< watchdog: sizing calls allowed per predicted element
  /// Lines on the domain that the mesh follows, ends included, instead of the ridges; those that meet do so
  /// in their ends.
  std::vector<std::vector<vec3>> lines = {};

  cgal_mesh_3 with_lines(std::vector<std::vector<vec3>> followed) const {
    cgal_mesh_3 changed = *this;
    changed.lines = std::move(followed);
    return changed;
  }

  /// Meshes the inside of `input.boundary`. Throws `mesher_error` when it is open, inverted, non-manifold or
  /// crosses itself, or when CGAL fails; `sizing_error` when the field gives an unusable size.
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const;
};

static_assert(piece_mesher<cgal_mesh_3, 3> && !boundary_keeping_mesher<cgal_mesh_3, 3>);

} // namespace dovetail::mesher

#ifndef DOVETAIL_COMPILED_CGAL
#include "dovetail/adapters/cgal_mesh_3.ipp"
#endif
