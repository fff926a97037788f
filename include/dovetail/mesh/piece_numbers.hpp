/// @file
/// From the numbers that points have in a skeleton to those in a piece.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/sequence.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// Made in n log n; a look-up is logarithmic.
class piece_numbers {
public:
  /// \param skeleton_points by point of the piece that is in the skeleton: its number there
  explicit piece_numbers(std::span<const local_id> skeleton_points) {
    for (std::size_t v = 0; v < skeleton_points.size(); ++v)
      numbers_.push_back({skeleton_points[v], static_cast<local_id>(v)});
    sort_all(numbers_);
  }

  /// Of a point that is in the piece.
  local_id operator[](local_id in_skeleton) const {
    return std::lower_bound(numbers_.begin(), numbers_.end(), std::pair(in_skeleton, local_id{0}))->second;
  }

private:
  std::vector<std::pair<local_id, local_id>> numbers_; ///< in the skeleton and in the piece
};

} // namespace dovetail::detail
