/// @file
/// What `simplify_coupled.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace dovetail::detail {

DOVETAIL_INLINE void require_surface_points(std::span<const local_id> volume_point,
                                            const simplicial_mesh<2>& surface,
                                            const simplicial_mesh<3>& volume) {
  if (volume_point.empty())
    return;
  if (volume_point.size() != surface.points.size())
    throw usage_error("simplify_coupled: " + std::to_string(volume_point.size()) +
                      " points of the volume for " + std::to_string(surface.points.size()) +
                      " points of the surface; give one each or none");
  for (std::size_t v = 0; v < volume_point.size(); ++v)
    if (volume_point[v] < 0 || static_cast<std::size_t>(volume_point[v]) >= volume.points.size())
      throw usage_error("simplify_coupled: point " + std::to_string(v) + " of the surface is point " +
                        std::to_string(volume_point[v]) + " of the volume, which has " +
                        std::to_string(volume.points.size()));
}

} // namespace dovetail::detail
