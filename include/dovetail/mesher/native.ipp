/// @file
/// What `native.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/mesher/native/boundary_points.hpp"
#include "dovetail/mesher/native/boundary_recovery.hpp"
#include "dovetail/mesher/native/inside_elements.hpp"
#include "dovetail/mesher/native/interior_points.hpp"
#include "dovetail/triangulation/delaunay.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::mesher {

DOVETAIL_INLINE mesher_result<3> native::operator()(const mesher_input<3>& input,
                                                    const any_sizing& size) const {
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
  result.summary.set("recovery_operations", static_cast<double>(recovered.operations));
  return result;
}

} // namespace dovetail::mesher
