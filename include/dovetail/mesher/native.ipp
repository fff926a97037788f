/// @file
/// What `native.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/mesher/native/boundary_points.hpp"
#include "dovetail/mesher/native/boundary_recovery.hpp"
#include "dovetail/mesher/native/inside_elements.hpp"
#include "dovetail/mesher/native/interior_points.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/triangulation/delaunay.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::mesher {

DOVETAIL_INLINE mesher_result<3> native::operator()(const mesher_input<3>& input,
                                                    const any_sizing& size) const {
  const stopwatch clock;
  require_enclosing(input.boundary);
  // Whatever number recovery finds below the last of the boundary's counts as a part of that.
  if (const auto used = detail::used_points(input.boundary); used.size() < input.boundary.points.size()) {
    auto result = (*this)({detail::without_unused_points(input.boundary, used), input.material}, size);
    detail::restore_unused_points(result.mesh, input.boundary.points, used);
    result.summary.set(mesher_counts{result.mesh.elements.size(), result.mesh.points.size()});
    return result;
  }
  const any_sizing sizes = size_scale == 1 ? size : keep_bounds(scaled<any_sizing>(size, size_scale));
  std::vector<vec3> points = input.boundary.points;
  append(points, interior_points(input.boundary, sizes));
  detail::append_far_corners(points);

  auto made = triangulate_points<3>(span_of(std::as_const(points)));
  detail::require_distinct_vertices(input.boundary, made.same_as);
  const boundary_sides sides(span_of(input.boundary.elements));
  const recovery_counts recovered = recover_boundary(made.triangulation, sides);
  mesher_result<3> result;
  result.mesh = inside_elements(made.triangulation, sides, input.boundary.points.size());
  result.mesh.tags.assign(result.mesh.elements.size(), input.material);

  result.summary.name = "native";
  result.summary.seconds = clock.seconds();
  result.summary.set(mesher_counts{result.mesh.elements.size(), result.mesh.points.size()});
  result.summary.set(native_counts{.missing_edges = recovered.missing_edges,
                                   .missing_triangles = recovered.missing_triangles,
                                   .recovery_splits = recovered.splits,
                                   .recovery_points = recovered.added_points - recovered.removed_points,
                                   .recovery_points_removed = recovered.removed_points,
                                   .recovery_operations = recovered.operations});
  return result;
}

} // namespace dovetail::mesher
