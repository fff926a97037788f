/// @file
/// Points and predicates by dimension, for what is written once for the plane and for space.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace dovetail {

/// `vec2` or `vec3`.
template <int D>
using point_of = std::conditional_t<D == 2, vec2, vec3>;

/// Where the points of the vertices of a simplex are kept.
template <int D>
using corner_places = std::array<const point_of<D>*, static_cast<std::size_t>(D) + 1>;

namespace detail {

constexpr std::array<double, 2> coordinates(vec2 p) {
  return {p.x, p.y};
}
constexpr std::array<double, 3> coordinates(vec3 p) {
  return {p.x, p.y, p.z};
}

/// Signs of determinants of points within one box. What is far from zero is decided by bounds that hold in
/// all of the box, which cost nothing (the static filters of S. Pion and A. Fabri,
/// doi 10.1016/j.scico.2010.09.003, with the constants of Shewchuk, doi 10.1007/PL00009321); of spheres most
/// others by the same bounds for the box around their points alone; the rest by the predicates of `core`.
template <int D>
class box_predicates {
public:
  using point = point_of<D>;

  box_predicates() = default;
  /// `extent` are the widths of a box that holds all the points.
  explicit box_predicates(const std::array<double, static_cast<std::size_t>(D)>& extent) {
    double product = 1, largest = 0;
    for (const double width : extent) {
      product *= width;
      largest = width > largest ? width : largest;
    }
    // With differences no larger than the widths the permanents are at most so many products of them.
    constexpr double orientation_terms = D == 2 ? 2 : 6;
    constexpr double orientation_factor = D == 2 ? 3 + 16 * half_ulp : 7 + 56 * half_ulp;
    orientation_bound_ = rounding * orientation_factor * half_ulp * orientation_terms * product;
    sphere_bound_ = rounding * sphere_factor * half_ulp * sphere_terms * product * largest * largest;
  }

  /// Positive when the simplex of these points is positively oriented.
  [[gnu::always_inline]] double orientation(const corner_places<D>& p) const {
    if constexpr (D == 2) {
      const vec2 b = *p[1] - *p[0], c = *p[2] - *p[0];
      const double value = plane_determinant<double>({b.x, b.y, c.x, c.y});
      return std::abs(value) > orientation_bound_ ? value : orient2d(*p[0], *p[1], *p[2]);
    } else {
      const vec3 b = *p[1] - *p[0], c = *p[2] - *p[0], d = *p[3] - *p[0];
      const double value = space_determinant<double>({b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z});
      return std::abs(value) > orientation_bound_ ? value : orient3d(*p[0], *p[1], *p[2], *p[3]);
    }
  }

  /// Positive when `q` is inside the sphere through the points of a positively oriented simplex.
  [[gnu::always_inline]] double in_sphere(const corner_places<D>& p, const point& q) const {
    if constexpr (D == 2) {
      const vec2 a = *p[0] - q, b = *p[1] - q, c = *p[2] - q;
      const double value = circle_determinant<double>({a.x, a.y, b.x, b.y, c.x, c.y});
      return std::abs(value) > sphere_bound_ ? value : in_circle(*p[0], *p[1], *p[2], q);
    } else {
      const vec3 a = *p[0] - q, b = *p[1] - q, c = *p[2] - q, d = *p[3] - q;
      const double value =
          sphere_determinant<double>({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z});
      return std::abs(value) > sphere_bound_ ? value : in_sphere_by_own_extent(value, p, q);
    }
  }

private:
  /// Decides by the extent of these points alone.
  [[gnu::noinline]] static double in_sphere_by_own_extent(double value, const corner_places<D>& p,
                                                          const point& q) requires(D == 3) {
    vec3 extent;
    for (const point* corner : p) {
      const vec3 v = *corner - q;
      extent = {std::max(extent.x, std::abs(v.x)), std::max(extent.y, std::abs(v.y)),
                std::max(extent.z, std::abs(v.z))};
    }
    constexpr double terms = sphere_terms / 3; // the square of a distance is at most that of the extent
    const double bound =
        rounding * sphere_factor * half_ulp * terms * (extent.x * extent.y * extent.z * norm_squared(extent));
    return std::abs(value) > bound ? value : dovetail::in_sphere(*p[0], *p[1], *p[2], *p[3], q);
  }

  static constexpr double sphere_terms = D == 2 ? 3 * 2 * 2 : 4 * 6 * 3;
  static constexpr double sphere_factor = D == 2 ? 10 + 96 * half_ulp : 16 + 224 * half_ulp;
  static constexpr double rounding = 1 + 16 * half_ulp; // of the differences and of this product
  double orientation_bound_ = 0;
  double sphere_bound_ = 0;
};

} // namespace detail
} // namespace dovetail
