/// @file
/// Point location by octree: for a point, the short list of items that may concern it.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/octree.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// Lists, at the leaves of an octree, of the items that reach into them. Where few items overlap a point, a
/// query costs one descent of at most `largest_depth` steps and reads a list of about `leaf_size`: faster
/// than a `box_tree`, whose boxes overlap, and larger. Built breadth first until lists are short, splitting
/// gains nothing, or there are 64 nodes per item. Queries are const and thread-safe.
class candidate_octree {
public:
  candidate_octree() = default;

  /// `reaches(item, box)`: may the item concern a point of the box? `narrow(box, items)` may take out more of
  /// those, which the others of them make needless everywhere in it. A false "yes" costs time only. Lists
  /// keep the order of `order`, which lists the items.
  template <class Reaches, class Narrow>
  candidate_octree(const box3& bounds, std::span<const local_id> order, Reaches&& reaches, Narrow&& narrow)
      : bounds_(bounds) {
    if (order.empty() || bounds.empty())
      return;
    tree_ = octree(cube_around(bounds));
    const std::size_t most_nodes = 64 * order.size() + 64;
    std::vector<listed_leaf> level{{0, {order.begin(), order.end()}}};
    narrow(tree_.bounds(), level.front().items);
    std::vector<listed_leaf> done;
    for (int depth = 0; !level.empty(); ++depth) {
      std::vector<listed_leaf> next;
      for (listed_leaf& leaf : level) {
        const bool may_split =
            leaf.items.size() > leaf_size && depth < largest_depth && tree_.node_count() + 8 <= most_nodes;
        if (!may_split || !split(leaf, reaches, narrow, next))
          done.push_back(std::move(leaf));
      }
      level.swap(next);
    }
    lists_ = sorted_into_rows<local_id>(tree_.leaf_count(), [&](const auto& put) {
      for (const listed_leaf& leaf : done)
        for (const local_id item : leaf.items)
          put(tree_.leaf_index(leaf.node), item);
    });
  }

  template <class Reaches>
  candidate_octree(const box3& bounds, std::span<const local_id> order, Reaches&& reaches)
      : candidate_octree(bounds, order, reaches, [](const box3&, std::vector<local_id>&) {}) {}

  /// The items that may concern p; none outside the bounds.
  std::span<const local_id> candidates(vec3 p) const {
    if (!contains(bounds_, p))
      return {};
    return lists_[tree_.leaf_index(tree_.locate(p))];
  }

private:
  static constexpr std::size_t leaf_size = 6;
  static constexpr int largest_depth = 16;

  struct listed_leaf {
    std::size_t node;
    std::vector<local_id> items;
  };

  /// Refuses when the eight lists together would be nearly eight times the old one: big items, nothing
  /// gained.
  template <class Reaches, class Narrow>
  bool split(const listed_leaf& leaf, Reaches&& reaches, Narrow&& narrow, std::vector<listed_leaf>& next) {
    // Rounding moves the centres of a descent by far less than this.
    const double margin = 1e-12 * (norm(bounds_.lower) + norm(bounds_.upper));
    const auto reach = [&](local_id item) {
      return [&reaches, item](const box3& part) { return reaches(item, part); };
    };
    const box3 box = tree_.box(leaf.node);
    auto lists = items_by_octant(box, leaf.items, reach, margin);
    std::size_t listed = 0;
    for (unsigned k = 0; k < 8; ++k) {
      narrow(inflated(octant(box, k), margin), lists[k]);
      listed += lists[k].size();
    }
    if (listed > 7 * leaf.items.size())
      return false;
    tree_.split(leaf.node);
    for (std::size_t k = 0; k < 8; ++k)
      next.push_back({tree_.child(leaf.node, k), std::move(lists[k])});
    return true;
  }

  box3 bounds_;
  octree tree_;
  compressed_rows<local_id> lists_; ///< per leaf
};

} // namespace dovetail
