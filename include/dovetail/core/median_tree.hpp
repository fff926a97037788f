/// @file
/// A binary tree over items that lie at points, for searches that keep bounds of their own in its nodes.
#pragma once

#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

/// What every node has; a search adds members and an `include(item)` that keeps them.
struct median_node {
  box3 box; ///< of the items' points
  std::size_t first = 0, last = 0;
  std::size_t right = 0; ///< 0 in a leaf; the left child follows its parent

  bool is_leaf() const { return right == 0; }
};

namespace detail {

template <class Node, class Item, class Place>
class median_tree_builder {
public:
  median_tree_builder(std::vector<Item>& items, std::size_t leaf_size, const Place& place)
      : items_(items), leaf_size_(leaf_size), place_(place) {}

  std::size_t build(std::size_t first, std::size_t last) {
    const std::size_t id = nodes.size();
    Node made;
    made.first = first;
    made.last = last;
    for (std::size_t i = first; i < last; ++i) {
      made.box.include(place_(items_[i]));
      made.include(items_[i]);
    }
    nodes.push_back(made);
    if (last - first <= leaf_size_)
      return id;
    const std::size_t middle = first + (last - first) / 2;
    split(first, middle, last, made.box.upper - made.box.lower);
    build(first, middle);
    const std::size_t right = build(middle, last);
    nodes[id].right = right;
    return id;
  }

  std::vector<Node> nodes;

private:
  void split(std::size_t first, std::size_t middle, std::size_t last, vec3 extent) {
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    Item* const items = items_.data();
    std::nth_element(items + first, items + middle, items + last,
                     [&](const Item& a, const Item& b) { return place_(a)[axis] < place_(b)[axis]; });
  }

  std::vector<Item>& items_;
  std::size_t leaf_size_;
  const Place& place_;
};

} // namespace detail

/// Nodes in depth-first order, the root first, none for no items; halves at the median along the longest
/// extent. Reorders the items, so that a node's are [first, last). O(n log n).
template <class Node, class Item, class Place>
std::vector<Node> build_median_tree(std::vector<Item>& items, std::size_t leaf_size, const Place& place) {
  detail::median_tree_builder<Node, Item, Place> builder(items, leaf_size, place);
  if (!items.empty())
    builder.build(0, items.size());
  return std::move(builder.nodes);
}

} // namespace dovetail
