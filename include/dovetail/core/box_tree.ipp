/// @file
/// What `box_tree.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE box_tree::box_tree(const std::vector<box3>& boxes, std::size_t leaf_size)
    : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), local_id{0});
  if (boxes.empty())
    return;
  std::vector<placed_item> placed(boxes.size());
  build(boxes, placed, leaf_size, 0, items_.size());
}

DOVETAIL_INLINE void box_tree::build(const std::vector<box3>& boxes, std::vector<placed_item>& placed,
                                     std::size_t leaf_size, std::size_t begin, std::size_t end) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({});
  box3 box;
  box3 centers;
  for (std::size_t i = begin; i < end; ++i) {
    const box3& item = boxes[items_[i]];
    box = united(box, item);
    centers.include(item.center());
  }
  nodes_[at].box = box;
  if (end - begin <= leaf_size) {
    nodes_[at].first = begin;
    nodes_[at].count = end - begin;
    return;
  }
  const vec3 extent = centers.upper - centers.lower;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  for (std::size_t i = begin; i < end; ++i)
    placed[i] = {boxes[items_[i]].center()[axis], items_[i]};
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(placed.data() + begin, placed.data() + middle, placed.data() + end,
                   [](const placed_item& a, const placed_item& b) {
                     return a.place != b.place ? a.place < b.place : a.item < b.item;
                   });
  for (std::size_t i = begin; i < end; ++i)
    items_[i] = placed[i].item;
  build(boxes, placed, leaf_size, begin, middle);
  nodes_[at].first = nodes_.size();
  build(boxes, placed, leaf_size, middle, end);
}

} // namespace dovetail
