/// @file
/// Sizes at the corners of an octree's leaves, and between them by trilinear interpolation.
#pragma once

#include "dovetail/core/octree.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
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
  double interpolated(std::size_t leaf, vec3 p) const;
  /// The same of a leaf's box and corners.
  double interpolated(const box3& box, const corner_ids& c, vec3 p) const;

  /// The least value in the part of the box that is in the octree, exactly: in a box of a leaf it is at a
  /// corner of it. Infinite when there is none. Visits what may hold less than what was found; after
  /// `find_least_values`.
  double least_in(const box3& box) const;

  /// To be called when all values are there.
  void find_least_values();

  octree tree_; ///< the cells
  std::vector<corner_ids>
      corners_;                ///< per leaf, corner k at the upper end of x, y, z where bits 0, 1, 2 are set
  std::vector<double> values_; ///< per corner

private:
  double least_of_leaf_in(std::size_t leaf, const box3& box) const;
  static vec3 corner_of(const box3& box, std::size_t k) {
    return {(k & 1U) != 0 ? box.upper.x : box.lower.x, (k & 2U) != 0 ? box.upper.y : box.lower.y,
            (k & 4U) != 0 ? box.upper.z : box.lower.z};
  }

  std::vector<double> least_below_; ///< per node of the octree
};

} // namespace dovetail::sizing

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/octree_values.ipp"
#endif
