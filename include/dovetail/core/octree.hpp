/// @file
/// A pointerless cube octree that can be refined, with integer keys for the corners of its leaves.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/vector.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dovetail {

/// Octant k of a box: its upper half along x, y, z where bits 0, 1, 2 of k are set.
constexpr box3 octant(const box3& box, unsigned k) {
  const vec3 center = box.center();
  box3 part = box;
  for (int axis = 0; axis < 3; ++axis)
    ((k >> axis & 1U) != 0 ? part.lower : part.upper)[axis] = center[axis];
  return part;
}

/// Visits a box and, where `enter(box, depth)` says so, its octants, depth first and in their order.
template <class Enter>
void descend_octants(const box3& box, Enter&& enter, int depth = 0) {
  if (enter(box, depth))
    for (unsigned k = 0; k < 8; ++k)
      descend_octants(octant(box, k), enter, depth + 1);
}

/// For each octant of a box, in their order, the items that may reach into it, `margin` beyond its faces:
/// those for which `reach(item)`, asked once an item, says so of the octant's box.
template <class Reach>
std::array<std::vector<local_id>, 8> items_by_octant(const box3& box, std::span<const local_id> items,
                                                     Reach&& reach, double margin = 0) {
  std::array<box3, 8> parts;
  for (unsigned k = 0; k < 8; ++k)
    parts[k] = inflated(octant(box, k), margin);
  std::array<std::vector<local_id>, 8> lists;
  for (const local_id item : items) {
    const auto reaches = reach(item);
    for (unsigned k = 0; k < 8; ++k)
      if (reaches(parts[k]))
        lists[k].push_back(item);
  }
  return lists;
}

/// The cube around a box, a little larger so that nothing lies on its faces.
inline box3 cube_around(const box3& box) {
  const vec3 extent = box.upper - box.lower;
  const double half = 0.5001 * (extent.x > extent.y ? (extent.x > extent.z ? extent.x : extent.z)
                                                    : (extent.y > extent.z ? extent.y : extent.z));
  const vec3 arm{half, half, half};
  return {box.center() - arm, box.center() + arm};
}

/// Nodes are numbered in the order they are made; children of a node are eight in a row, child k in the upper
/// half of x, y, z where bits 0, 1, 2 of k are set. At most `largest_depth` levels below the root.
class octree {
public:
  static constexpr int largest_depth = 20;
  /// A corner's place in units of the smallest leaf there can be, from the cube's lower corner.
  using key = std::array<std::uint32_t, 3>;

  octree();
  explicit octree(const box3& cube);

  /// The octree of the same cube and `splits()`, node by node. Throws `input_error` when these are of none.
  octree(const box3& cube, const std::vector<std::uint32_t>& splits);
  /// The inner nodes in the order in which they were split: with `bounds()` all that makes the octree.
  const std::vector<std::uint32_t>& splits() const { return splits_; }

  const box3& bounds() const { return cube_; }              ///< the root's cube
  std::size_t node_count() const { return nodes_.size(); }  ///< how many nodes, leaves included
  std::size_t leaf_count() const { return leaves_.size(); } ///< how many leaves there are
  /// The node that is the leaf of a number.
  std::size_t leaf(std::size_t index) const { return leaves_[index]; }
  /// The number among the leaves of a node that is one.
  std::size_t leaf_index(std::size_t leaf) const { return nodes_[leaf].link; }

  bool is_leaf(std::size_t node) const { return !nodes_[node].inner; } ///< whether a node has no children
  /// Child k of an inner node.
  std::size_t child(std::size_t node, std::size_t k) const { return nodes_[node].link + k; }

  /// Of any node but the first; its number is smaller.
  std::size_t parent(std::size_t node) const { return splits_[(node - 1) / 8]; }

  /// The leaf that contains p, which must lie in `bounds()`.
  std::size_t locate(vec3 p) const {
    const key place = smallest_leaf_around(p);
    std::size_t at = 0;
    for (int bit = largest_depth - 1; nodes_[at].inner; --bit)
      at = nodes_[at].link + (place[0] >> bit & 1U) + 2 * (place[1] >> bit & 1U) + 4 * (place[2] >> bit & 1U);
    return at;
  }

  /// The cube of a node.
  box3 box(std::size_t node) const {
    return {corner_point(corner_key(node, 0)), corner_point(corner_key(node, 7))};
  }

  /// The integer place of corner k of a node, equal for corners that coincide.
  key corner_key(std::size_t node, std::uint32_t k) const {
    const node_data& n = nodes_[node];
    const std::uint32_t width = width_of(n);
    return {n.lower[0] + (k & 1U) * width, n.lower[1] + (k >> 1 & 1U) * width, n.lower[2] + (k >> 2) * width};
  }
  /// Where a corner is.
  vec3 corner_point(const key& at) const {
    return cube_.lower +
           unit_ * vec3{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
  }

  /// Makes a leaf an inner node; nothing happens at the largest depth.
  void split(std::size_t leaf);

  /// Splits leaves while `too_coarse(box)`, level by level.
  template <class TooCoarse>
  void refine(TooCoarse&& too_coarse) {
    std::vector<std::size_t> level = leaves_;
    while (!level.empty()) {
      std::vector<std::size_t> next;
      for (const std::size_t leaf : level) {
        if (nodes_[leaf].depth == largest_depth || !too_coarse(box(leaf)))
          continue;
        split(leaf);
        for (std::size_t k = 0; k < 8; ++k)
          next.push_back(child(leaf, k));
      }
      level.swap(next);
    }
  }

  /// Visits the leaves below nodes that satisfy `enter`.
  template <class Enter, class Visit>
  void for_each_leaf(Enter&& enter, Visit&& visit) const {
    std::array<std::size_t, 7 * largest_depth + 8> pending;
    std::size_t depth = 0;
    pending[depth++] = 0;
    while (depth > 0) {
      const std::size_t at = pending[--depth];
      if (!enter(at))
        continue;
      if (!nodes_[at].inner)
        visit(at);
      else
        for (std::size_t k = 0; k < 8; ++k)
          pending[depth++] = child(at, k);
    }
  }

private:
  struct node_data {
    key lower{0, 0, 0};     ///< in units of the cube's width / 2^largest_depth
    std::uint32_t link = 0; ///< inner: its first child; leaf: its index among the leaves
    std::uint8_t depth = 0;
    bool inner = false;
  };

  static std::uint32_t width_of(const node_data& n) { return 1U << (largest_depth - n.depth); }
  /// The lower corner of the smallest leaf that there could be around p. The division may round to the leaf
  /// beside it, so p is compared with the ends too: leaves meet exactly where `corner_point` says.
  key smallest_leaf_around(vec3 p) const {
    constexpr std::int32_t last = (1 << largest_depth) - 1;
    key place;
    for (int axis = 0; axis < 3; ++axis) {
      const double lower = cube_.lower[axis], x = p[axis];
      const double leaves = (x - lower) / unit_;
      std::int32_t at = leaves > 0 ? static_cast<std::int32_t>(leaves < last ? leaves : last) : 0;
      if (at > 0 && x < lower + unit_ * at)
        --at;
      if (at < last && x >= lower + unit_ * (at + 1))
        ++at;
      place[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(at);
    }
    return place;
  }

  box3 cube_;
  double unit_; ///< the width of the smallest possible leaf
  std::vector<node_data> nodes_;
  std::vector<std::size_t> leaves_;
  std::vector<std::uint32_t> splits_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/octree.ipp"
#endif
