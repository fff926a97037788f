/// @file
/// Delaunay triangulation of points in the plane, inside a triangle that encloses them.
///
/// Points are inserted one by one along a space-filling curve and made Delaunay by flips. All decisions are
/// exact.
#pragma once

#include "dovetail/core/hilbert_curve.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/corner_table.hpp"
#include "dovetail/remesh/delaunay_flips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The permutation that sorts points along a Hilbert curve through their bounding box.
inline std::vector<local_id> order_along_curve(std::span<const vec2> points) {
  vec2 lower{1e300, 1e300}, upper{-1e300, -1e300};
  for (const vec2 p : points) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
  }
  constexpr int bits = 16;
  constexpr double cells = (1U << bits) - 1;
  const double wx = upper.x > lower.x ? cells / (upper.x - lower.x) : 0;
  const double wy = upper.y > lower.y ? cells / (upper.y - lower.y) : 0;
  std::vector<std::pair<std::uint64_t, local_id>> keyed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keyed[i] = {hilbert_place<2>({static_cast<std::uint32_t>((points[i].x - lower.x) * wx),
                                  static_cast<std::uint32_t>((points[i].y - lower.y) * wy)},
                                 bits),
                static_cast<local_id>(i)};
  std::sort(keyed.begin(), keyed.end());
  std::vector<local_id> order(points.size());
  for (std::size_t i = 0; i < keyed.size(); ++i)
    order[i] = keyed[i].second;
  return order;
}

/// Triangulates points when it is made; then keeps what is changed by flips Delaunay.
class point_triangulation {
public:
  explicit point_triangulation(std::span<const vec2> points) : points_(points.begin(), points.end()) {
    insert_points();
  }

  corner_table table;            ///< vertices are the given points, then the enclosing triangle's three
  std::vector<local_id> same_as; ///< per point: the point of lowest index with the same coordinates

  /// The first vertex of the enclosing triangle; the number of points given.
  local_id enclosing() const { return enclosing_; }
  vec2 xy(local_id v) const { return points_[v]; }

  /// Flips the sides opposite the queued corners, and those their flips expose, until all are Delaunay or
  /// constrained. Empties the queue.
  void restore_delaunay(std::vector<local_id>& corners) {
    flip_to_delaunay(
        table, [&](local_id vertex) { return xy(vertex); }, corners);
  }

private:
  vec2 corner_xy(local_id c) const { return xy(table.vertex[c]); }

  void insert_points() {
    const std::size_t count = points_.size();
    const std::vector<local_id> order = order_along_curve(span_of(points_));
    table.corner_of.assign(count, no_id);
    same_as.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      same_as[i] = static_cast<local_id>(i);
    add_enclosing_triangle();
    for (const local_id v : order) // of equal points, which are at one place of the curve, the lowest first
      insert(v);
  }

  /// Adds a triangle that holds all points far from its sides. Its vertices are ordinary points: the domain
  /// is bounded by constraints, so they have no influence on the triangles that stay.
  void add_enclosing_triangle() {
    vec2 lower{1e300, 1e300}, upper{-1e300, -1e300};
    for (const vec2 p : points_) {
      lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
      upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
    }
    const vec2 center = 0.5 * (lower + upper);
    const double far = std::max(std::abs(center.x), std::abs(center.y));
    double size = std::max({upper.x - lower.x, upper.y - lower.y, 1e-12 * far});
    if (!(size > 0))
      size = 1; // all points are the origin
    enclosing_ = static_cast<local_id>(points_.size());
    for (const vec2 corner : {vec2{-30, -20}, vec2{30, -20}, vec2{0, 40}}) {
      points_.push_back(center + size * corner);
      table.add_vertex();
    }
    last_ = table.add_triangle(enclosing_, enclosing_ + 1, enclosing_ + 2);
  }

  void insert(local_id v) {
    const vec2 p = xy(v);
    local_id t = last_;
    local_id came_from = no_id;
    for (bool moved = true; moved;) { // walk; exact orientations and a Delaunay triangulation: it ends
      moved = false;
      for (local_id i = 0; i < 3 && !moved; ++i) {
        const local_id c = 3 * t + i, across = table.twin[c];
        if (across == no_id || across == came_from)
          continue;
        if (orient2d(xy(table.tail(c)), xy(table.head(c)), p) < 0) {
          came_from = c;
          t = corner_table::triangle_of(across);
          moved = true;
        }
      }
    }
    last_ = t;
    local_id on_side = no_id;
    for (local_id i = 0; i < 3; ++i) {
      const local_id c = 3 * t + i;
      if (corner_xy(c) == p) {
        same_as[v] = table.vertex[c];
        return;
      }
      if (orient2d(xy(table.tail(c)), xy(table.head(c)), p) == 0)
        on_side = c;
    }
    if (on_side == no_id) {
      for (const local_id s : table.split_triangle(t, v))
        legalise_.push_back(3 * s + 2);
    } else {
      for (const local_id c : table.split_side(on_side, v))
        legalise_.push_back(c);
    }
    restore_delaunay(legalise_);
    last_ = corner_table::triangle_of(table.corner_of[v]);
  }

  std::vector<vec2> points_; // the given points, then the enclosing triangle's
  local_id enclosing_ = 0;
  local_id last_ = 0; // where the next walk begins
  std::vector<local_id> legalise_;
};

} // namespace dovetail::detail
