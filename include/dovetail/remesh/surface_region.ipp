/// @file
/// What `surface_region.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/remesh/surface_region.hpp"
#include "dovetail/sizing/refined_sizing.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE box3 place_of(const patch_boundary& boundary, const any_surface& surface) {
  if (boundary.segments.empty())
    return {};
  constexpr int steps = 6;
  std::vector<vec3> points = boundary.points;
  vec2 lower = boundary.uv.front(), upper = lower;
  for (const vec2 uv : boundary.uv) {
    lower = {std::min(lower.x, uv.x), std::min(lower.y, uv.y)};
    upper = {std::max(upper.x, uv.x), std::max(upper.y, uv.y)};
  }
  const vec2 step = (1.0 / steps) * (upper - lower);
  for (int i = 1; i < steps; ++i)
    for (int j = 1; j < steps; ++j)
      points.push_back(surface.frame({lower.x + i * step.x, lower.y + j * step.y}).point);
  return roomy_box_around(points);
}

DOVETAIL_INLINE region_of_face::region_of_face(const std::vector<surface_region>& regions) {
  for (std::size_t r = regions.size(); r-- > 0;) {
    const std::size_t face = place(regions[r].face);
    first_.resize(std::max(first_.size(), face + 1), no_id);
    first_[face] = static_cast<local_id>(r);
  }
}

DOVETAIL_INLINE bool region_of_face::has(local_id face) const {
  return face >= no_id && place(face) < first_.size() && first_[place(face)] != no_id;
}

DOVETAIL_INLINE std::size_t region_of_face::operator()(local_id face) const {
  const local_id r = first_.at(place(face));
  return r == no_id ? throw std::out_of_range("no region of this face") : static_cast<std::size_t>(r);
}

} // namespace dovetail
