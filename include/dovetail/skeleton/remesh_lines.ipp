/// @file
/// What `remesh_lines.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/skeleton/remesh_lines.hpp"

#include <array>
#include <span>

namespace dovetail {

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
