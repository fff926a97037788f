/// @file
/// What `piece_work.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/meshing/piece_work.hpp"
#include "dovetail/sizing/refined_sizing.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE box3 place_of(const piece_input<2>& input) {
  box3 box = roomy_box_around(input.boundary.boundary.points);
  for (const surface_region& region : input.boundary.regions)
    box = united(box, place_of(region.boundary, region.surface));
  return box;
}

DOVETAIL_INLINE std::string joined_reasons(const std::vector<std::string>& reasons) {
  std::string joined;
  for (std::size_t k = 0; k < reasons.size(); ++k) {
    if (std::find(reasons.begin(), reasons.begin() + static_cast<std::ptrdiff_t>(k), reasons[k]) !=
        reasons.begin() + static_cast<std::ptrdiff_t>(k))
      continue;
    std::string attempts;
    std::size_t count = 0;
    for (std::size_t other = k; other < reasons.size(); ++other)
      if (reasons[other] == reasons[k])
        attempts += (count++ > 0 ? ", " : " ") + std::to_string(other + 1);
    joined += (joined.empty() ? "" : "; ") + std::string(count > 1 ? "attempts" : "attempt") + attempts +
              ": " + reasons[k];
  }
  return joined.empty() ? "no attempt" : joined;
}

namespace detail {

DOVETAIL_INLINE void require_boundary(const mesher_input<2>& input) {
  const auto& [points, edges, tags] = input.boundary;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const local_id v : edges[e])
      if (v < 0 || static_cast<std::size_t>(v) >= points.size())
        throw mesher_error("boundary edge " + std::to_string(e) + " refers to point " + std::to_string(v) +
                           ", which does not exist");
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!is_finite(points[v]))
      throw mesher_error("boundary point " + std::to_string(v) + " is at " + place_text(points[v]) +
                         "; give finite coordinates");
}

} // namespace detail

} // namespace dovetail
