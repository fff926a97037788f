/// @file
/// What `coarse_skeleton.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE local_id find_line(const std::vector<skeleton_line>& lines, local_id a, local_id b) {
  const std::array<local_id, 2> key{std::min(a, b), std::max(a, b)};
  const auto found =
      std::lower_bound(lines.begin(), lines.end(), key,
                       [](const skeleton_line& line, const auto& wanted) { return line.vertices < wanted; });
  return found != lines.end() && found->vertices == key ? static_cast<local_id>(found - lines.begin())
                                                        : no_id;
}

} // namespace dovetail
