/// @file
/// An octree of a piece: what is inside, which boundary triangles are near, and the sizes.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/octree.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/inside_surface.hpp"
#include "dovetail/mesher/native/corner_sizes.hpp"
#include "dovetail/mesher/native/interior_point_options.hpp"
#include "dovetail/mesher/native/near_triangle.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

[[noreturn]] inline void throw_too_many_points(double most_points) {
  throw mesher_error("the sizes ask for more than " + number_text(most_points) +
                     " points inside; make them larger");
}

/// Cubes about as wide as one to two sizes where the piece is, large ones elsewhere. O((n + m) log n) for n
/// leaves and m triangles; a field is asked about once for each leaf and once for each triangle. Built once,
/// then const and thread-safe.
class piece_octree {
public:
  /// Throws `sizing_error` when a size is not positive and finite, `geometry_error` when the boundary is
  /// open, `mesher_error` when about as many points as the options allow, or more, were to be made, or the
  /// sizes are too small for an octree of the piece.
  piece_octree(const simplicial_mesh<2>& boundary, const any_sizing& size,
               const interior_point_options& options)
      : inside_(boundary), tree_(cube_around(inside_.bounds())) {
    collect_triangles(boundary, size);
    corner_sizes sizes(tree_, inside_.bounds(), size);
    build(size, sizes, options);
  }

  const octree& tree() const { return tree_; }
  /// Is the size the same wherever it was asked?
  bool is_uniform() const {
    const auto has_first = [&](double size) { return size == uniform_size(); };
    for (std::size_t n = 0; n < tree_.leaf_count(); ++n)
      if (const cell& at = cells_[tree_.leaf(n)];
          at.place != place::outside && !(at.is_constant && has_first(at.sizes[0]) && has_first(at.least)))
        return false;
    return true;
  }
  /// The size anywhere, where `is_uniform()`.
  double uniform_size() const { return triangles_.front().size(); }
  box3 bounds() const { return inside_.bounds(); }
  bool is_outside(std::size_t leaf) const { return cells_[leaf].place == place::outside; }
  /// At a point of the leaf, linear along its edges.
  double size_at(std::size_t leaf, vec3 p) const {
    const cell& at = cells_[leaf];
    const auto& h = at.sizes;
    if (at.is_constant)
      return h[0];
    const vec3 t = at.per_width * (p - at.lower);
    const auto along_x = [&](std::size_t k) { return h[k] + t.x * (h[k + 1] - h[k]); };
    const double y0 = along_x(0) + t.y * (along_x(2) - along_x(0));
    const double y1 = along_x(4) + t.y * (along_x(6) - along_x(4));
    return y0 + t.z * (y1 - y0);
  }
  double least_size(std::size_t leaf) const { return cells_[leaf].least; }
  double greatest_size(std::size_t leaf) const {
    return *std::max_element(cells_[leaf].sizes.begin(), cells_[leaf].sizes.end());
  }
  /// Is no triangle nearer to a point of the leaf than `clearance`, and p in the ball of none?
  bool is_clear(std::size_t leaf, vec3 p, double clearance) const {
    for (std::size_t k = cells_[leaf].first; k < cells_[leaf].end; ++k)
      if (const local_id t = near_[k];
          surroundings_[t].may_forbid(p, clearance) && triangles_[t].forbids(p, clearance))
        return false;
    return true;
  }
  /// Is a point of the leaf inside? Where it is clear, it need not be asked when another clear point is
  /// nearer than both their clearances together: both are inside or none is, as a triangle between them would
  /// be too near to one of them.
  bool is_inside(std::size_t leaf, vec3 p) const {
    return cells_[leaf].place == place::at_boundary ? inside_(p) : cells_[leaf].place == place::inside;
  }

private:
  enum class place : std::uint8_t { outside, inside, at_boundary };
  struct cell {
    std::array<double, 8> sizes{}; ///< at the corners, as `octree` numbers them
    vec3 lower;
    double per_width = 0;
    double least = 0;               ///< of the field in the leaf, as far as it is known, and of `sizes`
    std::size_t first = 0, end = 0; ///< of a leaf at the boundary: its triangles in `near_`
    detail::piece_octree::place place = place::outside;
    bool is_constant = false;
  };
  /// A triangle's size, and where it counts.
  struct seed {
    vec3 middle;
    double size;
  };
  /// A node in work, with the triangles that reach into it.
  struct open_node {
    std::size_t node;
    std::vector<local_id> triangles;
  };
  static constexpr double widest_leaf = 3;          ///< in sizes; sizes within a leaf are interpolated
  static constexpr double far_from_box = 4;         ///< in sizes
  static constexpr double nodes_per_point = 0.0625; ///< more are only made where a piece is thin

  void collect_triangles(const simplicial_mesh<2>& boundary, const any_sizing& size) {
    triangles_.reserve(boundary.elements.size());
    for (const auto& t : boundary.elements) {
      const auto at = [&](std::size_t k) { return boundary.points[t[k]]; };
      triangles_.emplace_back(std::array{at(0), at(1), at(2)}, size);
      surroundings_.push_back(triangles_.back().around());
      seeds_.push_back({triangles_.back().middle(), triangles_.back().size()});
      reaches_.push_back(triangles_.back().reach());
    }
  }

  /// Sizes that had to be made smaller want smaller leaves, where the field is asked anew.
  void build(const any_sizing& size, corner_sizes& sizes, const interior_point_options& options) {
    std::vector<local_id> all(triangles_.size());
    std::iota(all.begin(), all.end(), local_id{0});
    cells_.resize(1);
    corners_.resize(1);
    cells_[0].place = place::at_boundary;
    std::vector<open_node> open;
    open.push_back({0, std::move(all)});
    while (!open.empty()) {
      for (open_node& one : open)
        measure(one, size, sizes);
      refine(std::move(open), size, sizes, options);
      limit_growth(sizes, options.steepest);
      open = leaves_too_wide(options.cell);
    }
    reaches_ = {};
    seeds_ = {};
    corners_ = {};
  }

  /// Level by level, so that the number of points can be foreseen before the next one is made.
  void refine(std::vector<open_node> level, const any_sizing& size, corner_sizes& sizes,
              const interior_point_options& options) {
    while (!level.empty()) {
      std::vector<open_node> next;
      double points = points_in_kept_;
      for (open_node& one : level) {
        const double points_here = points_in(one.node, options.cell);
        points += points_here;
        if (!(points < options.most_points) ||
            static_cast<double>(tree_.node_count()) > nodes_per_point * options.most_points)
          throw_too_many_points(options.most_points);
        if (is_too_wide(one.node)) {
          split(one, next);
        } else {
          keep(one);
          points_in_kept_ += points_here;
        }
      }
      for (const open_node& one : next)
        measure(one, size, sizes);
      level.swap(next);
    }
  }

  /// Lowers sizes at corners until none is more than the growth allows above a triangle's or another's.
  void limit_growth(corner_sizes& sizes, double steepest) {
    for (const seed& from : seeds_)
      lower_around(from, sizes, steepest);
    const auto lower = [&](std::size_t leaf) {
      return cells_[leaf].place != place::outside && lower_within(leaf, sizes, steepest);
    };
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t n = 0; n < tree_.leaf_count(); ++n)
        changed = lower(tree_.leaf(n)) || changed;
      for (std::size_t n = tree_.leaf_count(); n-- > 0;)
        changed = lower(tree_.leaf(n)) || changed;
    }
    for (std::size_t n = 0; n < tree_.leaf_count(); ++n)
      take_sizes(tree_.leaf(n), sizes);
  }
  /// In the leaf that its middle is in: from there its size spreads like any other.
  void lower_around(const seed& from, corner_sizes& sizes, double steepest) const {
    const std::size_t leaf = tree_.locate(from.middle);
    for (unsigned c = 0; c < 8; ++c)
      sizes.lower(corners_[leaf][c], from.size + steepest * distance(from.middle, corner(leaf, c)));
  }
  bool lower_within(std::size_t leaf, corner_sizes& sizes, double steepest) {
    const auto& corners = corners_[leaf];
    double least = sizes[corners[0]], greatest = least;
    for (const std::uint32_t one : corners) {
      least = std::min(least, sizes[one]);
      greatest = std::max(greatest, sizes[one]);
    }
    const double over_edge = steepest * width_of(leaf);
    if (greatest - least <= over_edge)
      return false;
    bool changed = false;
    for (unsigned c = 0; c < 8; ++c)
      for (unsigned other = 0; other < 8; ++other) {
        const double edges = std::sqrt(static_cast<double>(std::popcount(c ^ other)));
        changed = sizes.lower(corners[c], sizes[corners[other]] + over_edge * edges) || changed;
      }
    return changed;
  }
  void take_sizes(std::size_t leaf, const corner_sizes& sizes) {
    cell& at = cells_[leaf];
    for (std::size_t c = 0; c < 8; ++c)
      at.sizes[c] = sizes[corners_[leaf][c]];
    const auto [least, greatest] = std::minmax_element(at.sizes.begin(), at.sizes.end());
    at.is_constant = *least == *greatest;
    at.least = std::min(at.least, *least);
    at.lower = tree_.box(leaf).lower;
    at.per_width = 1 / width_of(leaf);
  }
  std::vector<open_node> leaves_too_wide(double lattice_cell) {
    std::vector<open_node> found;
    points_in_kept_ = 0;
    for (std::size_t n = 0; n < tree_.leaf_count(); ++n) {
      const std::size_t leaf = tree_.leaf(n);
      if (cells_[leaf].place != place::outside && is_too_wide(leaf))
        found.push_back({leaf,
                         {near_.begin() + static_cast<std::ptrdiff_t>(cells_[leaf].first),
                          near_.begin() + static_cast<std::ptrdiff_t>(cells_[leaf].end)}});
      else
        points_in_kept_ += points_in(leaf, lattice_cell);
    }
    return found;
  }

  double width_of(std::size_t node) const {
    const box3 box = tree_.box(node);
    return box.upper.x - box.lower.x;
  }
  /// Leaves far from the piece's box may be of any width: around a needle that is far thinner than long those
  /// are nearly all that its triangles reach.
  bool is_too_wide(std::size_t node) const {
    const double least = cells_[node].least;
    return width_of(node) > widest_leaf * least &&
           inflated(inside_.bounds(), far_from_box * least).overlaps(tree_.box(node));
  }
  /// A lower estimate of the points that a node will hold: two per cell of the lattice, which is
  /// `lattice_cell` sizes wide.
  double points_in(std::size_t node, double lattice_cell) const {
    const double across = width_of(node) / (lattice_cell * greatest_size(node));
    return cells_[node].place == place::inside ? 2 * across * across * across : 0.0;
  }

  vec3 corner(std::size_t node, std::uint32_t k) const {
    return tree_.corner_point(tree_.corner_key(node, k));
  }

  void measure(const open_node& one, const any_sizing& size, corner_sizes& sizes) {
    cell& at = cells_[one.node];
    const box3 box = tree_.box(one.node);
    for (std::uint32_t k = 0; k < 8; ++k) {
      corners_[one.node][k] = sizes.number_of(tree_.corner_key(one.node, k));
      at.sizes[k] = sizes[corners_[one.node][k]];
    }
    at.least = *std::min_element(at.sizes.begin(), at.sizes.end());
    if (const double bound = smallest_size_in(size, box); bound > 0)
      at.least = std::min(at.least, bound);
    for (const local_id t : one.triangles)
      if (const seed& from = seeds_[t]; contains(box, from.middle))
        at.least = std::min(at.least, from.size);
  }

  void split(const open_node& one, std::vector<open_node>& next) {
    tree_.split(one.node);
    if (tree_.is_leaf(one.node))
      throw mesher_error("the sizes are less than a millionth of the extent of the boundary at " +
                         place_text(tree_.box(one.node).center()) + "; make them larger");
    cells_.resize(tree_.node_count());
    corners_.resize(tree_.node_count());
    auto lists = items_by_octant(tree_.box(one.node), span_of(one.triangles), [&](local_id t) {
      return [reach = reaches_[t]](const box3& part) { return reach.overlaps(part); };
    });
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t child = tree_.child(one.node, k);
      cells_[child].place = place_of(cells_[one.node].place, child, lists[k].empty());
      if (cells_[child].place != place::outside)
        next.push_back({child, std::move(lists[k])});
    }
  }
  place place_of(place parent, std::size_t child, bool is_clear) const {
    if (parent != place::at_boundary || !is_clear)
      return parent;
    return inside_(tree_.box(child).center()) ? place::inside : place::outside;
  }

  void keep(const open_node& one) {
    cell& at = cells_[one.node];
    at.first = near_.size();
    near_.insert(near_.end(), one.triangles.begin(), one.triangles.end());
    at.end = near_.size();
  }

  inside_surface inside_;
  octree tree_;
  std::vector<near_triangle> triangles_;
  std::vector<near_triangle::surroundings> surroundings_; ///< of each triangle
  std::vector<box3> reaches_;                             ///< of each triangle, while building
  std::vector<seed> seeds_;                               ///< of each triangle, while building
  std::vector<cell> cells_;                               ///< per node of the octree
  std::vector<std::array<std::uint32_t, 8>> corners_;     ///< of each node, while building
  std::vector<local_id> near_;                            ///< triangles, leaf by leaf
  double points_in_kept_ = 0; ///< foreseen in the leaves that are narrow enough, while building
};

} // namespace dovetail::detail
