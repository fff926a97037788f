/// @file
/// Point location by octree: for a point, the short list of items that may concern it.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/sequence.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// A static octree whose leaves list the items that reach into them. Where few items overlap a point, a query
/// costs one descent of at most `largest_depth` steps and reads a list of about `leaf_size`: faster than a
/// `box_tree`, whose boxes overlap, and larger. Built breadth first until lists are short, splitting gains
/// nothing, or there are 64 nodes per item. Queries are const and thread-safe.
class candidate_octree {
public:
  candidate_octree() = default;

  /// `reaches(item, box)`: may the item concern a point of the box? A false "yes" costs time only.
  /// Lists keep the order of `order`, which lists the items.
  template <class Reaches>
  candidate_octree(const box3& bounds, std::span<const local_id> order, Reaches&& reaches) : bounds_(bounds) {
    if (order.empty() || bounds.empty())
      return;
    const std::size_t most_nodes = 64 * order.size() + 64;
    std::vector<pending_leaf> level{{0, bounds, {order.begin(), order.end()}}};
    nodes_.push_back({});
    for (int depth = 0; !level.empty(); ++depth) {
      std::vector<pending_leaf> next;
      for (pending_leaf& leaf : level) {
        const bool may_split =
            leaf.items.size() > leaf_size && depth < largest_depth && nodes_.size() + 8 <= most_nodes;
        if (!may_split || !split(leaf, reaches, next))
          close(leaf);
      }
      level.swap(next);
    }
  }

  /// The items that may concern p; none outside the bounds.
  std::span<const local_id> candidates(vec3 p) const {
    if (nodes_.empty() || !contains(bounds_, p))
      return {};
    vec3 center = bounds_.center();
    vec3 step = 0.25 * (bounds_.upper - bounds_.lower);
    const node* at = &nodes_[0];
    while (at->count == inner) {
      const bool x = p.x >= center.x;
      const bool y = p.y >= center.y;
      const bool z = p.z >= center.z;
      at = &nodes_[at->first + (x ? 1U : 0U) + (y ? 2U : 0U) + (z ? 4U : 0U)];
      center += vec3{x ? step.x : -step.x, y ? step.y : -step.y, z ? step.z : -step.z};
      step = 0.5 * step;
    }
    return {items_.data() + at->first, at->count};
  }

private:
  static constexpr std::size_t leaf_size = 6;
  static constexpr int largest_depth = 16;
  static constexpr std::uint32_t inner = 0xffffffff;

  struct node {
    std::uint32_t first = 0; ///< inner: its eight children, in a row; leaf: its first item
    std::uint32_t count = 0; ///< `inner`, or the number of items of a leaf
  };
  struct pending_leaf {
    std::size_t node;
    box3 box;
    std::vector<local_id> items;
  };

  /// Child k takes the upper half along x, y, z where bits 0, 1, 2 of k are set: as `candidates` descends.
  static box3 octant(const box3& box, unsigned k) {
    const vec3 center = box.center();
    box3 part = box;
    for (int axis = 0; axis < 3; ++axis)
      ((k >> axis & 1U) != 0 ? part.lower : part.upper)[axis] = center[axis];
    return part;
  }

  /// Refuses when the eight lists together would be nearly eight times the old one: big items, nothing
  /// gained.
  template <class Reaches>
  bool split(pending_leaf& leaf, Reaches&& reaches, std::vector<pending_leaf>& next) {
    std::vector<pending_leaf> children;
    std::size_t listed = 0;
    // Rounding moves the centres of a descent by far less than this.
    const double margin = 1e-12 * (norm(bounds_.lower) + norm(bounds_.upper));
    for (unsigned k = 0; k < 8; ++k) {
      pending_leaf child{0, octant(leaf.box, k), {}};
      for (const local_id item : leaf.items)
        if (reaches(item, inflated(child.box, margin)))
          child.items.push_back(item);
      listed += child.items.size();
      children.push_back(std::move(child));
    }
    if (listed > 7 * leaf.items.size())
      return false;
    nodes_[leaf.node] = {static_cast<std::uint32_t>(nodes_.size()), inner};
    for (pending_leaf& child : children) {
      child.node = nodes_.size();
      nodes_.push_back({});
      next.push_back(std::move(child));
    }
    return true;
  }

  void close(const pending_leaf& leaf) {
    nodes_[leaf.node] = {static_cast<std::uint32_t>(items_.size()),
                         static_cast<std::uint32_t>(leaf.items.size())};
    append(items_, leaf.items);
  }

  box3 bounds_;
  std::vector<node> nodes_;
  std::vector<local_id> items_;
};

} // namespace dovetail
