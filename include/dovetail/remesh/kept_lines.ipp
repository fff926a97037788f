/// @file
/// What `kept_lines.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/remesh/kept_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE line_passages::line_passages(std::vector<directed_edge> listed,
                                             std::vector<directed_edge> passed)
    : listed_(std::move(listed)), passed_(std::move(passed)) {
  sort_all(listed_);
  sort_all(passed_);
}

DOVETAIL_INLINE std::vector<line_passages::directed_edge> line_passages::repeated() const {
  std::vector<directed_edge> found;
  for (std::size_t i = 0; i < passed_.size(); ++i)
    if ((i == 0 || passed_[i] != passed_[i - 1]) && times(passed_, passed_[i]) > allowed(passed_[i]))
      found.push_back(passed_[i]);
  return found;
}

DOVETAIL_INLINE void line_passages::check() const {
  std::size_t lost = 0;
  for (const directed_edge& edge : listed_) {
    const directed_edge back{edge[1], edge[0]};
    if (times(passed_, edge) > times(listed_, edge) || times(passed_, back) > times(listed_, back))
      throw mesher_error(
          "the elements overlap each other or the outside at the edge between boundary points " +
          std::to_string(edge[0]) + " and " + std::to_string(edge[1]));
    lost += times(passed_, edge) == 0 ? 1 : 0;
  }
  if (lost > 0)
    throw mesher_error(std::to_string(lost) + " of " + std::to_string(listed_.size()) +
                       " boundary edges are lost");
}

DOVETAIL_INLINE std::ptrdiff_t line_passages::times(const std::vector<directed_edge>& edges,
                                                    const directed_edge& edge) {
  const auto [first, last] = std::equal_range(edges.begin(), edges.end(), edge);
  return last - first;
}

DOVETAIL_INLINE std::ptrdiff_t line_passages::allowed(const directed_edge& edge) const {
  const auto here = times(listed_, edge);
  return here > 0 || times(listed_, {edge[1], edge[0]}) > 0 ? here : 1;
}

} // namespace dovetail
