/// @file
/// What `surface_checks.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/result_checks.hpp"
#include "dovetail/mesher/surface_checks.hpp"
#include "dovetail/remesh/kept_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

inline void check_lines_kept(const simplicial_mesh<1>& boundary, const simplicial_mesh<2>& mesh) {
  std::vector<simplex<1>> passed;
  for_each_edge_before(static_cast<local_id>(boundary.points.size()), mesh.elements,
                       [&](const simplex<1>& edge) { passed.push_back(edge); });
  line_passages(boundary.elements, std::move(passed)).check();
}

DOVETAIL_INLINE void check_entries(const mesher_input<2>& input, const simplicial_mesh<2>& mesh) {
  check_entries(mesh);
  if (input.regions.empty())
    return;
  const region_of_face find(input.regions);
  if (mesh.tags.size() != mesh.elements.size())
    throw mesher_error(std::to_string(mesh.tags.size()) + " faces are given for " +
                       std::to_string(mesh.elements.size()) + " elements");
  for (std::size_t e = 0; e < mesh.tags.size(); ++e)
    if (!find.has(mesh.tags[e]))
      throw mesher_error("element " + std::to_string(e) + " is on face " + std::to_string(mesh.tags[e]) +
                         ", which is not of this piece");
}

/// The area that the segments of a region enclose in its parameter plane.
inline double enclosed_area(const patch_boundary& boundary) {
  double area = 0;
  const vec2 origin = boundary.uv.empty() ? vec2{} : boundary.uv.front();
  for (const auto& [a, b] : boundary.segments)
    area += 0.5 * cross(boundary.uv[a] - origin, boundary.uv[b] - origin);
  return area;
}

/// A piece of plane regions: every element is oriented like its face, exactly, and the areas add up.
inline void check_planes_filled(const mesher_input<2>& input, const simplicial_mesh<2>& mesh) {
  const region_of_face find(input.regions);
  double expected = 0;
  for (const surface_region& region : input.regions)
    expected += enclosed_area(region.boundary);
  double area = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const surface_region& region = input.regions[find(mesh.tags[e])];
    std::array<vec2, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = region.surface.plane->project(mesh.points[mesh.elements[e][k]]);
    if (region.reversed)
      std::swap(at[1], at[2]);
    if (!(orient2d(at[0], at[1], at[2]) > 0))
      throw mesher_error("element " + std::to_string(e) + " is flat or inverted");
    area += 0.5 * cross(at[1] - at[0], at[2] - at[0]);
  }
  box3 box;
  for (const vec3 p : input.boundary.points)
    box.include(p);
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * std::pow(box.diagonal(), 2);
  if (!(std::abs(area - expected) <= 1e-9 * std::abs(expected) + rounding))
    throw mesher_error("the elements fill an area of " + number_text(area) + ", the lines enclose " +
                       number_text(expected));
}

} // namespace dovetail::detail

namespace dovetail {

DOVETAIL_INLINE void check_mesher_result(const mesher_input<2>& input, const simplicial_mesh<2>& mesh) {
  detail::check_entries(input, mesh);
  detail::check_points_kept(input.boundary.points, mesh.points);
  detail::check_points_used(input.boundary.points.size(), mesh);
  detail::check_lines_kept(input.boundary, mesh);
  if (!detail::fit_together<2>(input.boundary, mesh))
    detail::throw_no_fit();
  const bool planes = std::all_of(input.regions.begin(), input.regions.end(),
                                  [](const surface_region& r) { return r.surface.plane.has_value(); });
  if (planes && !input.regions.empty())
    detail::check_planes_filled(input, mesh);
}

} // namespace dovetail
