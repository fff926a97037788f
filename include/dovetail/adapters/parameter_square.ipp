/// @file
/// What `parameter_square.hpp` declares.
#pragma once

#include "dovetail/adapters/parameter_square.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/remesh/initial_patch.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE parameter_square::parameter_square(const any_surface& surface,
                                                   const patch_boundary& boundary) {
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
  for (const auto& [a, b] : boundary.segments)
    if (const local_id label = boundary.labels[a]; label == boundary.labels[b])
      poles_.push_back(label);
  sort_unique(poles_);
}

DOVETAIL_INLINE bool parameter_square::vanishes(const simplex<2>& t, const patch_boundary& boundary) const {
  const auto pole = [&](local_id v) {
    return v < static_cast<local_id>(boundary.labels.size()) &&
                   std::binary_search(poles_.begin(), poles_.end(), boundary.labels[v])
               ? boundary.labels[v]
               : no_id;
  };
  const std::array<local_id, 3> at{pole(t[0]), pole(t[1]), pole(t[2])};
  return (at[0] != no_id && (at[0] == at[1] || at[0] == at[2])) || (at[1] != no_id && at[1] == at[2]);
}

} // namespace dovetail::detail
