/// @file
/// Points in the leaves of a piece's octree, for the points around a place.
#pragma once

#include "dovetail/mesher/native/piece_octree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace dovetail::detail {

struct gathered_point {
  vec3 place;
  std::uint32_t id;
};

/// Leaves are about as wide as the size, so there are few points in each, and few leaves to look in. They
/// hold points in chunks next to each other in memory. A leaf's neighbours are looked up once, when first
/// wanted.
class point_grid {
public:
  /// For radii of at most `reach` times the size at the place.
  point_grid(const piece_octree& piece, double reach)
      : piece_(piece), reach_(reach), leaves_(piece.tree().node_count()) {
    for (std::size_t k = 0; k < piece.tree().leaf_count(); ++k) {
      const std::size_t leaf = piece.tree().leaf(k);
      const box3 box = piece.tree().box(leaf);
      leaves_[leaf].center = box.center();
      leaves_[leaf].half = 0.5 * (box.upper.x - box.lower.x);
    }
  }

  void add(std::size_t leaf, vec3 place, std::uint32_t id) {
    std::uint32_t& first = leaves_[leaf].first;
    if (first == none || chunks_[first].count == chunk::room) {
      chunks_.push_back({{}, 0, first});
      first = static_cast<std::uint32_t>(chunks_.size() - 1);
    }
    chunk& to = chunks_[first];
    to.points[to.count++] = {place, id};
  }

  bool has_points(std::size_t leaf) const { return leaves_[leaf].first != none; }

  /// The points within `radius` of a place in the leaf, in an order that depends on what was added alone.
  void gather(std::size_t leaf, vec3 place, double radius, std::vector<gathered_point>& to) {
    to.clear();
    if (leaves_[leaf].begin == leaves_[leaf].end)
      find_neighbours(leaf);
    const double bound = radius * radius;
    for (std::uint32_t k = leaves_[leaf].begin; k < leaves_[leaf].end; ++k) {
      const leaf_points& near = leaves_[neighbours_[k]];
      if (near.first == none || near.distance_squared_to(place) >= bound)
        continue;
      for (std::uint32_t at = near.first; at != none; at = chunks_[at].next)
        for (std::uint32_t i = 0; i < chunks_[at].count; ++i)
          if (norm_squared(chunks_[at].points[i].place - place) < bound)
            to.push_back(chunks_[at].points[i]);
    }
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct chunk {
    static constexpr std::uint32_t room = 6;
    std::array<gathered_point, room> points;
    std::uint32_t count;
    std::uint32_t next;
  };
  struct leaf_points {
    vec3 center;
    double half = 0;                  ///< of its width
    std::uint32_t first = none;       ///< of its chunks; only this one may have room
    std::uint32_t begin = 0, end = 0; ///< of its neighbours; none until wanted

    double distance_squared_to(vec3 p) const {
      const auto outside = [&](double x, double middle) {
        return std::max(std::abs(x - middle) - half, 0.0);
      };
      return norm_squared({outside(p.x, center.x), outside(p.y, center.y), outside(p.z, center.z)});
    }
  };

  void find_neighbours(std::size_t leaf) {
    const octree& tree = piece_.tree();
    const double reach = reach_ * piece_.greatest_size(leaf);
    const box3 box = inflated(tree.box(leaf), reach);
    leaves_[leaf].begin = static_cast<std::uint32_t>(neighbours_.size());
    visit(0, tree.bounds(), box);
    leaves_[leaf].end = static_cast<std::uint32_t>(neighbours_.size());
  }
  /// The leaves of a node that meet a box.
  void visit(std::size_t node, const box3& bounds, const box3& box) {
    const octree& tree = piece_.tree();
    if (tree.is_leaf(node)) {
      if (!piece_.is_outside(node))
        neighbours_.push_back(static_cast<std::uint32_t>(node));
      return;
    }
    const vec3 center = bounds.center();
    for (unsigned k = 0; k < 8; ++k) {
      bool meets = true;
      for (int axis = 0; axis < 3; ++axis)
        meets = meets &&
                ((k >> axis & 1U) != 0 ? box.upper[axis] >= center[axis] : box.lower[axis] < center[axis]);
      if (meets)
        visit(tree.child(node, k), octant(bounds, k), box);
    }
  }

  const piece_octree& piece_;
  double reach_;
  std::vector<leaf_points> leaves_; ///< per node of the octree
  std::vector<std::uint32_t> neighbours_;
  std::vector<chunk> chunks_;
};

} // namespace dovetail::detail
