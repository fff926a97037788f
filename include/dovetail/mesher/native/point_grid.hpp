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
#include <span>
#include <vector>

namespace dovetail::detail {

struct gathered_point {
  vec3 place;
  double size;
  std::uint32_t id;
};

/// Cells are leaves, or where all octants of a node are leaves the node: some sizes wide, so that a ball of a
/// size meets few of them. A cell's points lie in chunks that are searched in single precision, in units of
/// the cell; what that finds is looked at in double. A cell's neighbours are looked up once, when first
/// wanted.
class point_grid {
public:
  /// For radii of at most `reach` times the size at the place.
  point_grid(const piece_octree& piece, double reach)
      : piece_(piece), reach_(reach), cell_of_(piece.tree().node_count(), none),
        has_points_(piece.tree().node_count(), false) {
    const octree& tree = piece.tree();
    for (std::size_t k = 0; k < tree.leaf_count(); ++k) {
      const std::size_t node = node_of_cell(tree.leaf(k));
      if (cell_of_[node] == none)
        add_cell(node);
      cell_of_[tree.leaf(k)] = cell_of_[node];
    }
  }

  /// The point with the number of points before it, and the size there.
  void add(std::size_t leaf, vec3 place, double size) {
    cell& to = cells_[cell_of_[leaf]];
    if (to.first == none || chunks_[to.first].count == chunk::room) {
      chunks_.emplace_back().next = to.first;
      to.first = static_cast<std::uint32_t>(chunks_.size() - 1);
    }
    chunk& last = chunks_[to.first];
    const vec3 from_center = to.in_units(place - to.center);
    last.x[last.count] = static_cast<float>(from_center.x);
    last.y[last.count] = static_cast<float>(from_center.y);
    last.z[last.count] = static_cast<float>(from_center.z);
    const auto id = static_cast<std::uint32_t>(points_.size());
    last.ids[last.count++] = id;
    points_.push_back({place, size, id});
    has_points_[leaf] = true;
  }

  bool has_points(std::size_t leaf) const { return has_points_[leaf]; }

  /// The points within `radius` of a place in the leaf, in an order that depends on what was added alone.
  /// Stops and returns false when one is within `too_close`, which is at most `radius`.
  bool gather(std::size_t leaf, vec3 place, double radius, double too_close,
              std::vector<gathered_point>& to) {
    to.clear();
    cell& own = cells_[cell_of_[leaf]];
    if (own.begin == own.end)
      find_neighbours(own);
    const double bound = radius * radius, bound_of_close = too_close * too_close;
    for (const std::uint32_t number : cells_near(own, place, radius)) {
      const cell& other = cells_[number];
      const vec3 from_center = other.in_units(place - other.center);
      const float loose = loosened(radius * other.per_half, 1);
      for (std::uint32_t at = other.first; at != none; at = chunks_[at].next)
        for (const std::uint32_t id : points_near(chunks_[at], from_center, loose)) {
          const double squared = norm_squared(points_[id].place - place);
          if (squared < bound_of_close)
            return false;
          if (squared < bound)
            to.push_back(points_[id]);
        }
    }
    return true;
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct chunk {
    static constexpr std::size_t room = 8;
    std::array<float, room> x{}, y{}, z{}; ///< from the cell's centre, in halves of its width
    std::array<std::uint32_t, room> ids{};
    std::uint32_t count = 0;
    std::uint32_t next = none;
  };
  struct cell {
    vec3 center;
    double per_half = 0;              ///< 1 over half of its width
    std::uint32_t first = none;       ///< of its chunks; only this one may have room
    std::uint32_t begin = 0, end = 0; ///< of its neighbours; none until wanted
    std::uint32_t node = 0;

    vec3 in_units(vec3 v) const { return per_half * v; }
  };
  /// Cells near one, in the units of that, each with its own place in all arrays.
  struct neighbour_list {
    std::vector<float> x, y, z; ///< centres, from the centre of the one
    std::vector<float> half;    ///< of their widths
    std::vector<std::uint32_t> numbers;
  };

  /// The square of a radius, so much larger that single precision loses nothing within it: coordinates are
  /// some radii and widths.
  static float loosened(double radius, double half) {
    const double loose = radius + 1e-5 * (half + radius);
    return static_cast<float>(loose * loose);
  }
  /// How far a coordinate is outside of an interval.
  static float outside(float x, float center, float half) {
    const float beyond = std::abs(x - center) - half;
    return beyond > 0 ? beyond : 0;
  }

  /// The neighbours of a cell that may have points within a radius of a place in it. Distances are computed
  /// in a loop of their own, which compilers turn into vector instructions, and what is near is collected
  /// without a branch, which could not be foretold. So it is in `points_near`.
  std::span<const std::uint32_t> cells_near(const cell& own, vec3 place, double radius) {
    const std::size_t begin = own.begin, count = own.end - own.begin;
    const vec3 from_own = own.in_units(place - own.center);
    const auto px = static_cast<float>(from_own.x), py = static_cast<float>(from_own.y),
               pz = static_cast<float>(from_own.z),
               reach = static_cast<float>(radius * own.per_half * 1.00001);
    const float *x = neighbours_.x.data() + begin, *y = neighbours_.y.data() + begin,
                *z = neighbours_.z.data() + begin, *half = neighbours_.half.data() + begin;
    const std::uint32_t* numbers = neighbours_.numbers.data() + begin;
    excess_.resize(std::max(excess_.size(), count));
    near_cells_.resize(excess_.size());
    float* excess = excess_.data();
    for (std::size_t k = 0; k < count; ++k) {
      const float dx = outside(px, x[k], half[k]), dy = outside(py, y[k], half[k]),
                  dz = outside(pz, z[k], half[k]), loose = reach + 1e-5F * (1 + half[k]);
      excess[k] = dx * dx + dy * dy + dz * dz - loose * loose;
    }
    std::size_t found = 0;
    for (std::size_t k = 0; k < count; ++k) {
      near_cells_[found] = numbers[k];
      found += excess[k] <= 0 ? 1 : 0;
    }
    return {near_cells_.data(), found};
  }

  /// Those of a chunk whose squared distance is at most `bound`.
  std::span<const std::uint32_t> points_near(const chunk& in, vec3 place, float bound) {
    const auto x = static_cast<float>(place.x), y = static_cast<float>(place.y),
               z = static_cast<float>(place.z);
    std::array<float, chunk::room> squared;
    for (std::size_t i = 0; i < chunk::room; ++i) {
      const float dx = in.x[i] - x, dy = in.y[i] - y, dz = in.z[i] - z;
      squared[i] = dx * dx + dy * dy + dz * dz;
    }
    std::size_t found = 0;
    for (std::size_t i = 0; i < in.count; ++i) {
      near_points_[found] = in.ids[i];
      found += squared[i] <= bound ? 1 : 0;
    }
    return {near_points_.data(), found};
  }

  /// The node that the cell of a leaf is.
  std::size_t node_of_cell(std::size_t leaf) const {
    const octree& tree = piece_.tree();
    if (leaf == 0)
      return leaf;
    const std::size_t parent = tree.parent(leaf);
    for (std::size_t k = 0; k < 8; ++k)
      if (!tree.is_leaf(tree.child(parent, k)))
        return leaf;
    return parent;
  }
  void add_cell(std::size_t node) {
    cell_of_[node] = static_cast<std::uint32_t>(cells_.size());
    const box3 box = piece_.tree().box(node);
    cell& made = cells_.emplace_back();
    made.center = box.center();
    made.per_half = 2 / (box.upper.x - box.lower.x);
    made.node = static_cast<std::uint32_t>(node);
  }

  double greatest_size(std::size_t node) const {
    const octree& tree = piece_.tree();
    if (tree.is_leaf(node))
      return piece_.is_outside(node) ? 0 : piece_.greatest_size(node);
    double greatest = 0;
    for (std::size_t k = 0; k < 8; ++k)
      greatest = std::max(greatest, greatest_size(tree.child(node, k)));
    return greatest;
  }
  void find_neighbours(cell& of) {
    const octree& tree = piece_.tree();
    const box3 box = inflated(tree.box(of.node), reach_ * greatest_size(of.node));
    of.begin = static_cast<std::uint32_t>(neighbours_.numbers.size());
    visit(0, tree.bounds(), box, of);
    of.end = static_cast<std::uint32_t>(neighbours_.numbers.size());
  }
  /// The cells in a node that meet a box, as a cell sees them.
  void visit(std::size_t node, const box3& bounds, const box3& box, const cell& from) {
    const octree& tree = piece_.tree();
    if (const std::uint32_t number = cell_of_[node]; number != none) {
      const vec3 center = from.in_units(cells_[number].center - from.center);
      if (!tree.is_leaf(node) || !piece_.is_outside(node))
        add_neighbour(number, center, from.per_half / cells_[number].per_half);
      return;
    }
    const vec3 center = bounds.center();
    for (unsigned k = 0; k < 8; ++k) {
      bool meets = true;
      for (int axis = 0; axis < 3; ++axis)
        meets = meets &&
                ((k >> axis & 1U) != 0 ? box.upper[axis] >= center[axis] : box.lower[axis] < center[axis]);
      if (meets)
        visit(tree.child(node, k), octant(bounds, k), box, from);
    }
  }

  void add_neighbour(std::uint32_t number, vec3 center, double half) {
    neighbours_.x.push_back(static_cast<float>(center.x));
    neighbours_.y.push_back(static_cast<float>(center.y));
    neighbours_.z.push_back(static_cast<float>(center.z));
    neighbours_.half.push_back(static_cast<float>(half));
    neighbours_.numbers.push_back(number);
  }

  const piece_octree& piece_;
  double reach_;
  std::vector<std::uint32_t> cell_of_; ///< of the nodes that are cells, and of their leaves
  std::vector<bool> has_points_;       ///< per leaf
  std::vector<cell> cells_;
  neighbour_list neighbours_;
  std::vector<chunk> chunks_;
  std::vector<gathered_point> points_; ///< by number
  // Of the call at hand.
  std::vector<float> excess_;
  std::vector<std::uint32_t> near_cells_;
  std::array<std::uint32_t, chunk::room> near_points_;
};

} // namespace dovetail::detail
