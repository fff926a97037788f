/// @file
/// dovetail's own mesher of pieces: points first, all of them into one Delaunay tetrahedrization, then the
/// boundary by local changes.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/native/boundary_recovery.hpp"
#include "dovetail/mesher/native/inside_elements.hpp"
#include "dovetail/mesher/native/interior_points.hpp"
#include "dovetail/triangulation/delaunay.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::mesher {

/// A model of `boundary_keeping_mesher<3>` that needs no library and runs in threads.
///
/// Points of a lattice graded by the sizes are inserted together with those of the boundary; what the
/// Delaunay tetrahedrization lacks of the boundary is recovered by flips and a few points more. Elements are
/// not improved: slivers are left to the improver.
struct native {
  static constexpr mesher_traits traits{
      .keeps_boundary = true, .thread_safe = true, .accepts_non_manifold = true, .repeats_in_process = true};
  /// Elements made per unit of the integral of h^-3.
  static constexpr double elements_per_inverse_cubed_size = 9.8;

  double size_scale = 1.0; ///< multiplies the field

  /// Meshes the inside of `input.boundary`. Throws `mesher_error` when a part of the boundary could not be
  /// recovered, which it names; `sizing_error` when the field gives an unusable size.
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const;
};

} // namespace dovetail::mesher

namespace dovetail::detail {

/// Corners of a box so far around the points that no side of the convex hull is near any of them: all that
/// recovery changes then lies between finite elements.
inline void append_far_corners(std::vector<vec3>& points) {
  constexpr double distance = 2; // over the diagonal of the points' box
  box3 box;
  for (const vec3 p : points)
    box.include(p);
  const double reach = distance * box.diagonal();
  for (unsigned k = 0; k < 8; ++k)
    points.push_back(box.center() + reach * vec3{(k & 1U) != 0 ? 1.0 : -1.0, (k & 2U) != 0 ? 1.0 : -1.0,
                                                 (k & 4U) != 0 ? 1.0 : -1.0});
}

/// Two vertices of the boundary at one place can be given by no tetrahedrization.
inline void require_distinct_vertices(const simplicial_mesh<2>& boundary,
                                      const std::vector<local_id>& same_as) {
  for (const auto& triangle : boundary.elements)
    for (const local_id v : triangle)
      if (same_as[at(v)] != v)
        throw mesher_error("boundary points " + std::to_string(same_as[at(v)]) + " and " + std::to_string(v) +
                           " are both at " + place_text(boundary.points[at(v)]) + "; make them one");
}

} // namespace dovetail::detail

namespace dovetail::mesher {

inline mesher_result<3> native::operator()(const mesher_input<3>& input, const any_sizing& size) const {
  const stopwatch clock;
  require_enclosing(input.boundary);
  const any_sizing scaled = [&](vec3 p) { return size_scale * size(p); };
  std::vector<vec3> points = input.boundary.points;
  append(points, interior_points(input.boundary, scaled));
  detail::append_far_corners(points);

  auto made = triangulate_points<3>(span_of(std::as_const(points)));
  detail::require_distinct_vertices(input.boundary, made.same_as);
  const recovery_counts recovered = recover_boundary(made.triangulation, span_of(input.boundary.elements));
  mesher_result<3> result;
  result.mesh =
      inside_elements(made.triangulation, span_of(input.boundary.elements), input.boundary.points.size());
  result.mesh.tags.assign(result.mesh.elements.size(), input.material);
  check_mesher_result(input, result.mesh);

  result.summary.name = "native";
  result.summary.seconds = clock.seconds();
  result.summary.set("elements", static_cast<double>(result.mesh.elements.size()));
  result.summary.set("points", static_cast<double>(result.mesh.points.size()));
  result.summary.set("missing_edges", static_cast<double>(recovered.missing_edges));
  result.summary.set("missing_triangles", static_cast<double>(recovered.missing_triangles));
  result.summary.set("recovery_splits", static_cast<double>(recovered.splits));
  result.summary.set("recovery_points",
                     static_cast<double>(recovered.added_points - recovered.removed_points));
  result.summary.set("recovery_points_removed", static_cast<double>(recovered.removed_points));
  return result;
}

static_assert(boundary_keeping_mesher<native, 3>);

} // namespace dovetail::mesher
