/// @file
/// Sizes at the corners of an octree's leaves, and between them by trilinear interpolation.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/octree.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace dovetail::sizing {

/// What fields that are precomputed on an octree have in common; how it is refined and filled is theirs.
class octree_values {
public:
  std::size_t leaf_count() const { return tree_.leaf_count(); } ///< leaves of the octree

protected:
  explicit octree_values(const box3& cube) : tree_(cube) {}

  using corner_ids = std::array<std::uint32_t, 8>; ///< where the sizes at a leaf's eight corners are

  /// At a point of a leaf.
  double interpolated(std::size_t leaf, vec3 p) const {
    const box3 box = tree_.box(leaf);
    const vec3 extent = box.upper - box.lower;
    const vec3 t{(p.x - box.lower.x) / extent.x, (p.y - box.lower.y) / extent.y,
                 (p.z - box.lower.z) / extent.z};
    const corner_ids& c = corners_[tree_.leaf_index(leaf)];
    const auto along_x = [&](std::size_t k) {
      return values_[c[k]] + t.x * (values_[c[k + 1]] - values_[c[k]]);
    };
    const double y0 = along_x(0) + t.y * (along_x(2) - along_x(0));
    const double y1 = along_x(4) + t.y * (along_x(6) - along_x(4));
    return y0 + t.z * (y1 - y0);
  }

  /// The least value in the part of the box that is in the octree, exactly: in a box of a leaf it is at a
  /// corner of it. Infinite when there is none. Visits what may hold less than what was found; after
  /// `find_least_values`.
  double least_in(const box3& box) const {
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

  /// To be called when all values are there.
  void find_least_values() {
    least_below_.assign(tree_.node_count(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < tree_.leaf_count(); ++k)
      for (const std::uint32_t corner : corners_[k])
        least_below_[tree_.leaf(k)] = std::min(least_below_[tree_.leaf(k)], values_[corner]);
    for (std::size_t node = tree_.node_count(); node-- > 1;) // children come after their parent
      least_below_[tree_.parent(node)] = std::min(least_below_[tree_.parent(node)], least_below_[node]);
  }

  octree tree_; ///< the cells
  std::vector<corner_ids>
      corners_;                ///< per leaf, corner k at the upper end of x, y, z where bits 0, 1, 2 are set
  std::vector<double> values_; ///< per corner

private:
  double least_of_leaf_in(std::size_t leaf, const box3& box) const {
    const box3 whole = tree_.box(leaf);
    box3 part = whole;
    for (int k = 0; k < 3; ++k) {
      part.lower[k] = std::max(whole.lower[k], box.lower[k]);
      part.upper[k] = std::min(whole.upper[k], box.upper[k]);
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 8; ++k)
      least = std::min(least, interpolated(leaf, corner_of(part, k)));
    return least;
  }
  static vec3 corner_of(const box3& box, std::size_t k) {
    return {(k & 1U) != 0 ? box.upper.x : box.lower.x, (k & 2U) != 0 ? box.upper.y : box.lower.y,
            (k & 4U) != 0 ? box.upper.z : box.lower.z};
  }

  std::vector<double> least_below_; ///< per node of the octree
};

} // namespace dovetail::sizing
