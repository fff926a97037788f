/// @file
/// The parameter plane as meshers of the plane want it: axes that resemble lengths, and an extent near 1.
#pragma once

#include "dovetail/remesh/initial_patch.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dovetail::detail {

/// The loops of a patch on coordinates where the parameters resemble lengths and the largest extent is 1,
/// which suits libraries' absolute tolerances.
struct parameter_square {
  std::vector<vec2> xy; ///< of the boundary's vertices
  vec2 scale{1, 1};     ///< parameters times this, less `lower`, are xy
  vec2 lower{0, 0};

  template <patch_surface S>
  parameter_square(const S& surface, const patch_boundary& boundary) {
    std::vector<surface_frame> frames;
    frames.reserve(boundary.uv.size());
    for (const vec2 uv : boundary.uv)
      frames.push_back(surface.frame(uv));
    scale = parameter_scale(frames);
    box3 box;
    for (const vec2 uv : boundary.uv)
      box.include({uv.x * scale.x, uv.y * scale.y, 0});
    scale = 1 / std::max(box.upper.x - box.lower.x, box.upper.y - box.lower.y) * scale;
    lower = {boundary.uv.front().x * scale.x, boundary.uv.front().y * scale.y};
    for (const vec2 uv : boundary.uv)
      xy.push_back({uv.x * scale.x - lower.x, uv.y * scale.y - lower.y});
    join_touching_vertices(boundary, xy);
  }

  vec2 uv(vec2 p) const { return {(p.x + lower.x) / scale.x, (p.y + lower.y) / scale.y}; }

  /// Whether two corners of a triangle of the square are the same point of a pole: then it is none in space.
  static bool vanishes(const simplex<2>& t, const patch_boundary& boundary) {
    const auto& labels = boundary.labels;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      if (a < labels.size() && b < labels.size() && labels[a] == labels[b])
        return true;
    }
    return false;
  }
};

} // namespace dovetail::detail
