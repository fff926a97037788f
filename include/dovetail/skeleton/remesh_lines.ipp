/// @file
/// What `remesh_lines.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/remesh/line_spacing.hpp"
#include "dovetail/skeleton/remesh_lines.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace dovetail {

namespace detail {

DOVETAIL_INLINE fine_line space_straight(const skeleton_line& line, vec3 first, vec3 last,
                                         const any_sizing& size) {
  const auto straight = [&](double s) { return curve_frame{first + s * (last - first), last - first}; };
  const auto s = remesh::line_spacing{
      .even_when_few = true, .given_segments = line.segments, .bias = line.bias}(straight, 0.0, 1.0, size);
  fine_line fine;
  for (std::size_t i = 1; i + 1 < s.size(); ++i)
    fine.points.push_back(straight(s[i]).point);
  return fine;
}

} // namespace detail

DOVETAIL_INLINE box3 place_of(const skeleton_line& line, std::span<const vec3> coarse_points) {
  const std::array ends{coarse_points[line.vertices[0]], coarse_points[line.vertices[1]]};
  return roomy_box_around(ends);
}

DOVETAIL_INLINE kept<fine_line> kept_line(const skeleton_line& line, std::span<const vec3> coarse_points,
                                          const refined_sizing& size) {
  const std::array ends{coarse_points[line.vertices[0]], coarse_points[line.vertices[1]]};
  return kept<fine_line>::of(line.on, line.t, line.uv, line.segments, line.bias, ends,
                             size.balls_near(place_of(line, coarse_points)));
}

} // namespace dovetail
