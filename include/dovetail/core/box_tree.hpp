/// @file
/// A static bounding-volume tree over axis-aligned boxes: which boxes may concern a query.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
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

/// The box grown by `margin` on every side.
inline box3 inflated(const box3& box, double margin) {
  const vec3 by{margin, margin, margin};
  return {box.lower - by, box.upper + by};
}

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
/// depends on the boxes and their order only. Queries are const and thread-safe.
class box_tree {
public:
  box_tree() = default;
  explicit box_tree(const std::vector<box3>& boxes) : items_(boxes.size()) {
    std::iota(items_.begin(), items_.end(), local_id{0});
    if (!boxes.empty())
      build(boxes, 0, items_.size());
  }

  bool empty() const { return items_.empty(); }
  /// The box around everything; empty for an empty tree.
  box3 bounds() const { return nodes_.empty() ? box3{} : nodes_.front().box; }
  std::size_t node_count() const { return nodes_.size(); }

  /// Calls `visit(item)` for every item in leaves all of whose ancestors satisfy `enter(box, node)`; the
  /// item's own box is not tested. `node` in [0, node_count()) lets a caller keep bounds of its own per node.
  template <class Enter, class Visit>
  void for_each(Enter&& enter, Visit&& visit) const {
    if (nodes_.empty())
      return;
    std::array<std::size_t, max_depth> pending;
    std::size_t depth = 0;
    pending[depth++] = 0;
    while (depth > 0) {
      const std::size_t at = pending[--depth];
      const node& n = nodes_[at];
      if (!enter(n.box, at))
        continue;
      if (n.count > 0) {
        for (std::size_t i = n.first; i < n.first + n.count; ++i)
          visit(items_[i]);
      } else {
        pending[depth++] = n.first;
        pending[depth++] = at + 1;
      }
    }
  }

  /// As `for_each`, nearer child first: with `enter` comparing against the best distance so far this is a
  /// nearest-item search.
  template <class Enter, class Visit>
  void for_each_near(vec3 p, Enter&& enter, Visit&& visit) const {
    if (nodes_.empty())
      return;
    std::array<std::size_t, max_depth> pending;
    std::size_t depth = 0;
    pending[depth++] = 0;
    while (depth > 0) {
      const std::size_t at = pending[--depth];
      const node& n = nodes_[at];
      if (!enter(n.box, at))
        continue;
      if (n.count > 0) {
        for (std::size_t i = n.first; i < n.first + n.count; ++i)
          visit(items_[i]);
      } else {
        const bool left_first =
            distance_squared(nodes_[at + 1].box, p) <= distance_squared(nodes_[n.first].box, p);
        pending[depth++] = left_first ? n.first : at + 1;
        pending[depth++] = left_first ? at + 1 : n.first;
      }
    }
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
  static constexpr std::size_t leaf_size = 4;
  static constexpr std::size_t max_depth = 64; // halving: deeper would need 2^64 items

  struct node {
    box3 box;
    std::size_t first = 0; ///< leaf: first item; inner: the right child (the left one follows its parent)
    std::size_t count = 0; ///< items of a leaf; 0 for an inner node
  };

  void build(const std::vector<box3>& boxes, std::size_t begin, std::size_t end) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({});
    box3 box;
    box3 centers;
    for (std::size_t i = begin; i < end; ++i) {
      const box3& item = boxes[static_cast<std::size_t>(items_[i])];
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
    const auto key = [&](local_id item) { return boxes[static_cast<std::size_t>(item)].center()[axis]; };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(items_.data() + begin, items_.data() + middle, items_.data() + end,
                     [&](local_id a, local_id b) {
                       const double ka = key(a);
                       const double kb = key(b);
                       return ka != kb ? ka < kb : a < b;
                     });
    build(boxes, begin, middle);
    nodes_[at].first = nodes_.size();
    build(boxes, middle, end);
  }

  std::vector<node> nodes_;
  std::vector<local_id> items_;
};

} // namespace dovetail
