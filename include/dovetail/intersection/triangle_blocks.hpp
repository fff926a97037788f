/// @file
/// Boxes around triangles that follow each other, so that most of a large set is passed over at once.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// The box of a triangle.
inline box3 box_of(std::span<const vec3> points, const simplex<2>& triangle) {
  box3 box;
  for (const local_id v : triangle)
    box.include(points[v]);
  return box;
}

/// Blocks of consecutive triangles: in a mesh that was made patch by patch most are near each other. 1.5
/// bytes per triangle; made in O(n).
class triangle_blocks {
public:
  static constexpr std::size_t block_size = 32; ///< triangles of a block, at most

  triangle_blocks(std::span<const vec3> points, std::span<const simplex<2>> triangles)
      : triangles_(triangles.size()), boxes_((triangles.size() + block_size - 1) / block_size) {
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
      box3 box; // not in place: the compiler would write it back after each point
      for_each(b, [&](local_id t) {
        for (const local_id v : triangles[t])
          box.include(points[v]);
      });
      boxes_[b] = box;
    }
  }

  std::size_t size() const { return boxes_.size(); }
  /// The box around the triangles of a block.
  const box3& box(std::size_t block) const { return boxes_[block]; }

  /// Calls `visit(t)` for the triangles of a block, by growing number.
  template <class Visit>
  void for_each(std::size_t block, Visit&& visit) const {
    const std::size_t end = std::min(triangles_, (block + 1) * block_size);
    for (std::size_t t = block * block_size; t < end; ++t)
      visit(static_cast<local_id>(t));
  }

private:
  std::size_t triangles_;
  std::vector<box3> boxes_;
};

} // namespace dovetail
