/// @file
/// A static bounding-volume tree over axis-aligned boxes: which boxes may concern a query.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail {

/// The smallest box around two boxes.
inline box3 united(box3 a, const box3& b) {
  for (int k = 0; k < 3; ++k) {
    a.lower[k] = std::min(a.lower[k], b.lower[k]);
    a.upper[k] = std::max(a.upper[k], b.upper[k]);
  }
  return a;
}

/// Whether `p` is in the box, its sides included.
inline bool contains(const box3& box, vec3 p) {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y &&
         box.lower.z <= p.z && p.z <= box.upper.z;
}

/// Squared distance from a point to a box; zero inside.
inline double distance_squared(const box3& box, vec3 p) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double outside = std::max({box.lower[k] - p[k], p[k] - box.upper[k], 0.0});
    sum += outside * outside;
  }
  return sum;
}

/// Distance between two boxes; zero when they overlap.
inline double distance(const box3& a, const box3& b) {
  vec3 gap;
  for (int k = 0; k < 3; ++k)
    gap[k] = std::max({a.lower[k] - b.upper[k], b.lower[k] - a.upper[k], 0.0});
  return norm(gap);
}

/// Binary tree over `n` boxes, split at the median centre along the longest axis. Built in O(n log n), it
/// depends on the boxes and their order only. Queries are const and thread-safe. Searches over points, or
/// that go by more than boxes, keep bounds of their own per node (`reduce`).
class box_tree {
public:
  box_tree() = default;
  explicit box_tree(const std::vector<box3>& boxes, std::size_t leaf_size = 4);

  bool empty() const { return items_.empty(); }
  /// The box around everything; empty for an empty tree.
  box3 bounds() const { return nodes_.empty() ? box3{} : nodes_.front().box; }
  std::size_t node_count() const { return nodes_.size(); } ///< how many nodes, leaves included
  /// The bounds of node `at`; the root is node 0.
  const box3& box(std::size_t at) const { return nodes_[at].box; }

  /// Puts the items that the boxes belong to in the order of the tree, and numbers them so from now on: those
  /// of a leaf then are next to each other in memory.
  template <class Item>
  void put_in_order(std::vector<Item>& items) {
    std::vector<Item> ordered;
    ordered.reserve(items.size());
    for (const local_id item : items_)
      ordered.push_back(std::move(items[item]));
    items = std::move(ordered);
    std::iota(items_.begin(), items_.end(), local_id{0});
  }

  /// Calls `visit(item)` for every item in leaves all of whose ancestors satisfy `enter(node)`; the item's
  /// own box is not tested. `node` in [0, node_count()) lets a caller keep bounds of its own per node. Of two
  /// children the right one is first where `prefers(right, left)`.
  template <class Enter, class Visit, class Prefers>
  void search(Enter&& enter, Visit&& visit, Prefers&& prefers) const {
    if (nodes_.empty())
      return;
    std::array<std::size_t, max_depth> pending;
    std::size_t depth = 0;
    pending[depth++] = 0;
    while (depth > 0) {
      const std::size_t at = pending[--depth];
      if (!enter(at))
        continue;
      const node& n = nodes_[at];
      if (n.count > 0) {
        for (std::size_t i = n.first; i < n.first + n.count; ++i)
          visit(items_[i]);
      } else {
        const bool right_first = prefers(n.first, at + 1);
        pending[depth++] = right_first ? at + 1 : n.first;
        pending[depth++] = right_first ? n.first : at + 1;
      }
    }
  }

  /// As `search` with `enter(box, node)`, left children first.
  template <class Enter, class Visit>
  void for_each(Enter&& enter, Visit&& visit) const {
    search([&](std::size_t at) { return enter(nodes_[at].box, at); }, visit,
           [](std::size_t, std::size_t) { return false; });
  }

  /// Whether one of the boxes that the tree is of overlaps another box.
  bool any_overlaps(const std::vector<box3>& boxes, const box3& other) const {
    bool found = false;
    for_each([&](const box3& around, std::size_t) { return !found && around.overlaps(other); },
             [&](local_id item) { found = found || boxes[item].overlaps(other); });
    return found;
  }

  /// As `for_each`, nearer child first: with `enter` comparing against the best distance so far this is a
  /// nearest-item search.
  template <class Enter, class Visit>
  void for_each_near(vec3 p, Enter&& enter, Visit&& visit) const {
    search([&](std::size_t at) { return enter(nodes_[at].box, at); }, visit,
           [&](std::size_t right, std::size_t left) {
             return distance_squared(nodes_[right].box, p) < distance_squared(nodes_[left].box, p);
           });
  }

  /// The least of `bound` and `value(item)` for all items, given that `lower_bound(node)` exceeds no value
  /// below the node; what promises less is searched first.
  template <class LowerBound, class Value>
  double least(double bound, LowerBound&& lower_bound, Value&& value) const {
    if (nodes_.empty())
      return bound;
    struct promise {
      double bound;
      std::size_t at;
    };
    std::array<promise, max_depth> pending;
    std::size_t depth = 0;
    pending[depth++] = {lower_bound(std::size_t{0}), 0};
    while (depth > 0) {
      const promise next = pending[--depth];
      if (!(next.bound < bound))
        continue;
      const node& n = nodes_[next.at];
      if (n.count > 0) {
        for (std::size_t i = n.first; i < n.first + n.count; ++i)
          bound = std::min(bound, value(items_[i]));
      } else {
        promise near{lower_bound(next.at + 1), next.at + 1};
        promise far{lower_bound(n.first), n.first};
        if (far.bound < near.bound)
          std::swap(near, far);
        pending[depth++] = far;
        pending[depth++] = near;
      }
    }
    return bound;
  }

  /// Bottom-up reduction to one value per node: `leaf(item)` for items, `join(a, b)` to combine. O(n).
  template <class T, class Leaf, class Join>
  std::vector<T> reduce(Leaf&& leaf, Join&& join) const {
    std::vector<T> values(nodes_.size());
    for (std::size_t at = nodes_.size(); at-- > 0;) {
      const node& n = nodes_[at];
      if (n.count == 0) {
        values[at] = join(values[at + 1], values[n.first]);
        continue;
      }
      values[at] = leaf(items_[n.first]);
      for (std::size_t i = n.first + 1; i < n.first + n.count; ++i)
        values[at] = join(values[at], leaf(items_[i]));
    }
    return values;
  }

private:
  static constexpr std::size_t max_depth = 64; // halving: deeper would need 2^64 items

  struct node {
    box3 box;
    std::size_t first = 0; ///< leaf: first item; inner: the right child (the left one follows its parent)
    std::size_t count = 0; ///< items of a leaf; 0 for an inner node
  };

  /// An item, and where its centre is along one axis: what halving compares lies side by side.
  struct placed_item {
    double place;
    local_id item;
  };

  /// `placed` is room for as many as there are items.
  void build(const std::vector<box3>& boxes, std::vector<placed_item>& placed, std::size_t leaf_size,
             std::size_t begin, std::size_t end);

  std::vector<node> nodes_;
  std::vector<local_id> items_;
};

/// The boxes of points, to build a tree over items that lie at `place(item)`.
template <class Item, class Place>
std::vector<box3> boxes_of_points(const std::vector<Item>& items, const Place& place) {
  std::vector<box3> boxes;
  boxes.reserve(items.size());
  for (const Item& item : items)
    boxes.push_back({place(item), place(item)});
  return boxes;
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/box_tree.ipp"
#endif
