/// @file
/// Elements that fill a small region from one point, which sees the whole boundary of it.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// Four equations for four unknowns, by elimination. Nothing when they depend on each other.
inline std::optional<std::array<double, 4>> solution_of(std::array<std::array<double, 4>, 4> rows,
                                                        std::array<double, 4> values) {
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i)
      if (std::abs(rows[i][k]) > std::abs(rows[pivot][k]))
        pivot = i;
    if (rows[pivot][k] == 0)
      return std::nullopt;
    std::swap(rows[k], rows[pivot]);
    std::swap(values[k], values[pivot]);
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == k)
        continue;
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 4; ++j)
        rows[i][j] -= factor * rows[k][j];
      values[i] -= factor * values[k];
    }
  }
  for (std::size_t k = 0; k < 4; ++k)
    values[k] /= rows[k][k];
  return values;
}

/// The point in front of the planes of all triangles that is farthest from the nearest of them. Where there
/// is no point in front of all the result is any point.
///
/// A linear program in the point and its distance, solved by the simplex method on its dual: from the point
/// that has four planes at one distance to the next, always with the plane that is nearest in place of one of
/// the four. It begins with the planes of a large tetrahedron.
inline vec3 point_before_all(std::span<const std::array<vec3, 3>> triangles) {
  using row = std::array<double, 4>;
  constexpr std::size_t most_exchanges = 200;
  box3 box;
  for (const auto& t : triangles)
    for (const vec3 corner : t)
      box.include(corner);
  const vec3 middle = box.center();
  const double unit = box.diagonal();
  std::vector<row> planes; // normal n and value d: n . p - distance >= d
  std::vector<double> values;
  const auto add = [&](vec3 n, double d) {
    planes.push_back({n.x, n.y, n.z, -1});
    values.push_back(d);
  };
  constexpr double far = 2; // the region is half a unit around its middle
  for (const vec3 n : {vec3{1, 1, 1}, vec3{1, -1, -1}, vec3{-1, 1, -1}, vec3{-1, -1, 1}})
    add(normalized(n), -far);
  for (const auto& t : triangles) {
    const vec3 n = normalized(cross(t[2] - t[0], t[1] - t[0]));
    if (std::isfinite(n.x + n.y + n.z))
      add(n, dot(n, t[0] - middle) / unit);
  }
  std::array<std::size_t, 4> tight{0, 1, 2, 3};
  vec3 best = middle;
  for (std::size_t exchange = 0; exchange < most_exchanges; ++exchange) {
    std::array<row, 4> rows, columns;
    row right{};
    for (std::size_t k = 0; k < 4; ++k) {
      rows[k] = planes[tight[k]];
      right[k] = values[tight[k]];
      for (std::size_t j = 0; j < 4; ++j)
        columns[j][k] = rows[k][j];
    }
    const auto found = solution_of(rows, right);
    if (!found)
      break;
    const vec3 p{(*found)[0], (*found)[1], (*found)[2]};
    best = middle + unit * p;
    std::size_t nearest = 0;
    double least = -1e-14; // no nearer than rounding makes it
    for (std::size_t i = 0; i < planes.size(); ++i)
      if (const double excess =
              dot(vec3{planes[i][0], planes[i][1], planes[i][2]}, p) - (*found)[3] - values[i];
          excess < least && std::find(tight.begin(), tight.end(), i) == tight.end()) {
        least = excess;
        nearest = i + 1;
      }
    if (nearest == 0)
      break;
    const auto shares = solution_of(columns, {0, 0, 0, -1}),
               entering = solution_of(columns, planes[--nearest]);
    if (!shares || !entering)
      break;
    std::size_t leaving = 4;
    double least_ratio = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      constexpr double rounding = 1e-13;
      if (!((*entering)[k] > rounding))
        continue;
      const double ratio = std::max((*shares)[k], 0.0) / (*entering)[k];
      if (leaving == 4 || ratio < least_ratio ||
          (ratio == least_ratio && (*entering)[k] > (*entering)[leaving])) {
        leaving = k;
        least_ratio = ratio;
      }
    }
    if (leaving == 4)
      break;
    tight[leaving] = nearest;
  }
  return best;
}

/// A vertex or a new point from which elements fill a region.
struct star_center {
  vec3 point;
  local_id vertex = no_id; ///< none: the point is new
  /// The least distance from the plane of a side the center is not a corner of, over the size of the region;
  /// 0 where some element would not be positive.
  double clearance = 0;
};

/// Finds centers of regions that sides close, which are oriented outwards.
class star_centers {
public:
  /// With less clearance than this elements are flat but for rounding.
  static constexpr double least_good = 1e-9;

  explicit star_centers(local_changes& changes) : changes_(changes) {}

  /// A corner of the sides if one has good clearance; else that or the point that has more.
  star_center best(std::span<const simplex<2>> sides) {
    const star_center corner = best_corner(sides);
    if (corner.clearance >= least_good)
      return corner;
    const star_center fresh = clear_point(sides);
    return fresh.clearance > corner.clearance ? fresh : corner;
  }
  /// The corner of the sides that has most clearance.
  star_center best_corner(std::span<const simplex<2>> sides) {
    corners_.clear();
    for (const auto& side : sides)
      corners_.insert(corners_.end(), side.begin(), side.end());
    sort_unique(corners_);
    star_center best;
    for (const local_id v : corners_) {
      if (v < 0)
        return {};
      star_center corner{changes_.point(v), v};
      corner.clearance = clearance(corner, sides);
      if (corner.clearance > best.clearance)
        best = corner;
    }
    return best;
  }
  /// A new point as far as can be from the nearest of the sides, whether it is in front of it or not.
  star_center clear_point(std::span<const simplex<2>> sides) {
    triangles_.clear();
    for (const auto& [a, b, c] : sides) {
      if (a < 0 || b < 0 || c < 0)
        return {};
      triangles_.push_back({changes_.point(a), changes_.point(b), changes_.point(c)});
    }
    constexpr std::size_t exchanges = 10; // as many as there often are
    changes_.count_work(exchanges * sides.size());
    star_center center{point_before_all(triangles_)};
    center.clearance = clearance(center, sides);
    return center;
  }
  double clearance(const star_center& center, std::span<const simplex<2>> sides) const {
    box3 box;
    double least = 1e300;
    for (const auto& side : sides) {
      if (side[0] < 0 || side[1] < 0 || side[2] < 0)
        return 0;
      box.include(changes_.point(side[0]));
      if (side[0] == center.vertex || side[1] == center.vertex || side[2] == center.vertex)
        continue;
      if (!is_before(side, center.point))
        return 0;
      least = std::min(least, height(side, center.point));
    }
    return std::max(least / box.diagonal(), 1e-300); // not 0 by rounding
  }
  /// Of a point over the plane of a side.
  double height(const simplex<2>& side, vec3 p) const {
    const vec3 a = changes_.point(side[0]), b = changes_.point(side[1]), c = changes_.point(side[2]);
    return dot(normalized(cross(c - a, b - a)), p - a);
  }

  /// Adds to `fresh` the elements between a center and the sides it is not a corner of.
  void add_star(const star_center& center, std::span<const simplex<2>> sides,
                std::vector<simplex<3>>& fresh) const {
    const local_id v = center.vertex != no_id ? center.vertex : changes_.add_point(center.point);
    for (const auto& [a, b, c] : sides)
      if (a != v && b != v && c != v)
        fresh.push_back({v, a, b, c});
  }

private:
  bool is_before(const simplex<2>& side, vec3 p) const {
    return changes_.orientation(p, side[0], side[1], side[2]) > 0;
  }

  local_changes& changes_;
  std::vector<local_id> corners_;
  std::vector<std::array<vec3, 3>> triangles_;
};

} // namespace dovetail::detail
