/// @file
/// What `octree.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/octree.hpp"
#include "dovetail/core/vector.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE octree::octree() : octree(box3{{0, 0, 0}, {1, 1, 1}}) {}

DOVETAIL_INLINE octree::octree(const box3& cube)
    : cube_(cube), unit_((cube.upper.x - cube.lower.x) / static_cast<double>(1U << largest_depth)) {
  nodes_.push_back({});
  leaves_.push_back(0);
}

DOVETAIL_INLINE octree::octree(const box3& cube, const std::vector<std::uint32_t>& splits) : octree(cube) {
  for (const std::uint32_t node : splits) {
    if (node >= nodes_.size() || nodes_[node].inner || nodes_[node].depth == largest_depth)
      throw input_error("the nodes of an octree are damaged");
    split(node);
  }
}

DOVETAIL_INLINE void octree::split(std::size_t leaf) {
  const node_data parent = nodes_[leaf];
  if (parent.inner || parent.depth == largest_depth)
    return;
  const std::uint32_t half = width_of(parent) / 2;
  const std::uint32_t index = parent.link;
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  splits_.push_back(static_cast<std::uint32_t>(leaf));
  nodes_[leaf].inner = true;
  nodes_[leaf].link = first;
  for (std::uint32_t k = 0; k < 8; ++k) {
    node_data child;
    child.lower = {parent.lower[0] + (k & 1U) * half, parent.lower[1] + (k >> 1 & 1U) * half,
                   parent.lower[2] + (k >> 2) * half};
    child.depth = static_cast<std::uint8_t>(parent.depth + 1);
    child.link = k == 0 ? index : static_cast<std::uint32_t>(leaves_.size());
    if (k == 0)
      leaves_[index] = first;
    else
      leaves_.push_back(first + k);
    nodes_.push_back(child);
  }
}

} // namespace dovetail
