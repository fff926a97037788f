/// @file
/// What `chords.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/remesh/chords.hpp"

#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE chord_finder::chord_finder(std::vector<local_id> labels, std::span<const simplex<1>> segments)
    : labels_(std::move(labels)) {
  for (const auto& [a, b] : segments)
    segments_.push_back(labels_of(a, b));
  sort_all(segments_);
}

DOVETAIL_INLINE std::vector<simplex<1>> chord_finder::all(std::span<const simplex<2>> triangles) const {
  std::vector<simplex<1>> chords;
  for (const simplex<2>& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if ((*this)(triangle[k], triangle[(k + 1) % 3]))
        chords.push_back(sorted_vertices(simplex<1>{triangle[k], triangle[(k + 1) % 3]}));
  sort_unique(chords);
  return chords;
}

DOVETAIL_INLINE std::vector<local_id> chord_finder::counted(std::size_t points) {
  std::vector<local_id> labels(points);
  std::iota(labels.begin(), labels.end(), 0);
  return labels;
}

} // namespace dovetail
