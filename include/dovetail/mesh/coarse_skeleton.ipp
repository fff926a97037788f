/// @file
/// What `coarse_skeleton.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
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

DOVETAIL_INLINE line_index::line_index(const std::vector<skeleton_line>& lines) : lines_(lines) {
  first_.assign(lines.empty() ? 1 : static_cast<std::size_t>(lines.back().vertices[0]) + 2, 0);
  for (const skeleton_line& line : lines)
    ++first_[static_cast<std::size_t>(line.vertices[0]) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
}

DOVETAIL_INLINE local_id line_index::find(local_id a, local_id b) const {
  const auto smaller = static_cast<std::size_t>(std::min(a, b));
  const local_id larger = std::max(a, b);
  if (smaller + 1 < first_.size())
    for (local_id l = first_[smaller]; l < first_[smaller + 1]; ++l)
      if (lines_[l].vertices[1] == larger)
        return l;
  return no_id;
}

} // namespace dovetail
