/// @file
/// What `octree_values.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/sizing/octree_values.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace dovetail::sizing {

DOVETAIL_INLINE double octree_values::interpolated(std::size_t leaf, vec3 p) const {
  return interpolated(tree_.box(leaf), corners_[tree_.leaf_index(leaf)], p);
}

DOVETAIL_INLINE double octree_values::interpolated(const box3& box, const corner_ids& c, vec3 p) const {
  const vec3 extent = box.upper - box.lower;
  const vec3 t{(p.x - box.lower.x) / extent.x, (p.y - box.lower.y) / extent.y,
               (p.z - box.lower.z) / extent.z};
  const auto along_x = [&](std::size_t k) {
    return values_[c[k]] + t.x * (values_[c[k + 1]] - values_[c[k]]);
  };
  const double y0 = along_x(0) + t.y * (along_x(2) - along_x(0));
  const double y1 = along_x(4) + t.y * (along_x(6) - along_x(4));
  return y0 + t.z * (y1 - y0);
}

DOVETAIL_INLINE double octree_values::least_in(const box3& box) const {
  double least = std::numeric_limits<double>::infinity();
  tree_.for_each_leaf(
      [&](std::size_t node) {
        if (least_below_[node] >= least)
          return false;
        const box3 whole = tree_.box(node);
        if (!whole.overlaps(box))
          return false;
        if (!contains(box, whole.lower) || !contains(box, whole.upper))
          return true;
        least = least_below_[node];
        return false;
      },
      [&](std::size_t leaf) { least = std::min(least, least_of_leaf_in(leaf, box)); });
  return least;
}

DOVETAIL_INLINE void octree_values::find_least_values() {
  least_below_.assign(tree_.node_count(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < tree_.leaf_count(); ++k)
    for (const std::uint32_t corner : corners_[k])
      least_below_[tree_.leaf(k)] = std::min(least_below_[tree_.leaf(k)], values_[corner]);
  for (std::size_t node = tree_.node_count(); node-- > 1;) // children come after their parent
    least_below_[tree_.parent(node)] = std::min(least_below_[tree_.parent(node)], least_below_[node]);
}

DOVETAIL_INLINE double octree_values::least_of_leaf_in(std::size_t leaf, const box3& box) const {
  const box3 whole = tree_.box(leaf);
  box3 part = whole;
  for (int k = 0; k < 3; ++k) {
    part.lower[k] = std::max(whole.lower[k], box.lower[k]);
    part.upper[k] = std::min(whole.upper[k], box.upper[k]);
  }
  const corner_ids& corners = corners_[tree_.leaf_index(leaf)];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 8; ++k)
    least = std::min(least, interpolated(whole, corners, corner_of(part, k)));
  return least;
}

} // namespace dovetail::sizing
