/// @file
/// Orientation and in-circle tests with the exact sign: a floating-point filter, then exact expansions.
///
/// The filters' error bounds and the arithmetic of expansions are those of J. R. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", doi 10.1007/PL00009321. Exact
/// as long as no intermediate product over- or underflows.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "dovetail needs IEEE arithmetic: compile without -ffast-math and its parts (docs/building.md)"
#endif

#include "dovetail/core/vector.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dovetail {

namespace detail {

/// The exact value of a sum of doubles, kept as non-overlapping terms of increasing magnitude.
/// `Capacity` bounds the number of terms.
template <std::size_t Capacity>
struct expansion {
  std::array<double, Capacity> terms;
  std::size_t size = 0;

  /// Adds one double; keeps the terms non-overlapping (Shewchuk, GROW-EXPANSION with zero elimination).
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const double sum = value + terms[i];
      const double virtual_part = sum - value;
      const double roundoff = (value - (sum - virtual_part)) + (terms[i] - virtual_part);
      if (roundoff != 0)
        terms[kept++] = roundoff;
      value = sum;
    }
    if (value != 0)
      terms[kept++] = value;
    size = kept;
  }
  /// The sign of the exact value, carried by the largest term.
  double sign() const { return size == 0 ? 0.0 : terms[size - 1] > 0 ? 1.0 : -1.0; }
};

template <std::size_t N>
void add_product(expansion<N>& to, double a, double b) {
  const double product = a * b;
  to.add(std::fma(a, b, -product));
  to.add(product);
}

template <std::size_t A, std::size_t B>
expansion<2 * A * B> operator*(const expansion<A>& a, const expansion<B>& b) {
  expansion<2 * A * B> result;
  for (std::size_t i = 0; i < a.size; ++i)
    for (std::size_t j = 0; j < b.size; ++j)
      add_product(result, a.terms[i], b.terms[j]);
  return result;
}

template <std::size_t A, std::size_t B>
expansion<A + B> operator+(const expansion<A>& a, const expansion<B>& b) {
  expansion<A + B> result;
  for (std::size_t i = 0; i < a.size; ++i)
    result.terms[result.size++] = a.terms[i];
  for (std::size_t j = 0; j < b.size; ++j)
    result.add(b.terms[j]);
  return result;
}

template <std::size_t A>
expansion<A> operator-(expansion<A> a) {
  for (std::size_t i = 0; i < a.size; ++i)
    a.terms[i] = -a.terms[i];
  return a;
}

inline expansion<2> exact_difference(double a, double b) {
  expansion<2> result;
  result.add(a);
  result.add(-b);
  return result;
}

inline constexpr double half_ulp = std::numeric_limits<double>::epsilon() / 2;

inline double orient2d_exact(vec2 a, vec2 b, vec2 c) {
  const auto abx = exact_difference(b.x, a.x), aby = exact_difference(b.y, a.y);
  const auto acx = exact_difference(c.x, a.x), acy = exact_difference(c.y, a.y);
  return (abx * acy + -(aby * acx)).sign();
}

inline double orient3d_exact(vec3 a, vec3 b, vec3 c, vec3 d) {
  const auto bx = exact_difference(b.x, a.x), by = exact_difference(b.y, a.y),
             bz = exact_difference(b.z, a.z);
  const auto cx = exact_difference(c.x, a.x), cy = exact_difference(c.y, a.y),
             cz = exact_difference(c.z, a.z);
  const auto dx = exact_difference(d.x, a.x), dy = exact_difference(d.y, a.y),
             dz = exact_difference(d.z, a.z);
  const auto nx = by * cz + -(bz * cy), ny = bz * cx + -(bx * cz), nz = bx * cy + -(by * cx);
  return (nx * dx + ny * dy + nz * dz).sign();
}

inline double in_circle_exact(vec2 a, vec2 b, vec2 c, vec2 d) {
  const auto ax = exact_difference(a.x, d.x), ay = exact_difference(a.y, d.y);
  const auto bx = exact_difference(b.x, d.x), by = exact_difference(b.y, d.y);
  const auto cx = exact_difference(c.x, d.x), cy = exact_difference(c.y, d.y);
  const auto a_lift = ax * ax + ay * ay, b_lift = bx * bx + by * by, c_lift = cx * cx + cy * cy;
  const auto bc = bx * cy + -(by * cx), ca = cx * ay + -(cy * ax), ab = ax * by + -(ay * bx);
  return (a_lift * bc + b_lift * ca + c_lift * ab).sign();
}

} // namespace detail

/// Positive when c lies to the left of the line from a to b, zero when the three are collinear, exactly. The
/// magnitude is twice the triangle's area up to rounding, or 1 when the filter could not decide.
inline double orient2d(vec2 a, vec2 b, vec2 c) {
  const double left = (b.x - a.x) * (c.y - a.y);
  const double right = (b.y - a.y) * (c.x - a.x);
  const double value = left - right;
  const double bound = (3 + 16 * detail::half_ulp) * detail::half_ulp * (std::abs(left) + std::abs(right));
  return std::abs(value) > bound ? value : detail::orient2d_exact(a, b, c);
}

/// Positive when the tetrahedron (a, b, c, d) is positively oriented, (b-a) x (c-a) . (d-a) > 0, zero when
/// the four are coplanar, exactly. The magnitude is six times the volume up to rounding, or 1 when the filter
/// could not decide.
inline double orient3d(vec3 a, vec3 b, vec3 c, vec3 d) {
  const vec3 ab = b - a, ac = c - a, ad = d - a;
  const double yz = ab.y * ac.z, zy = ab.z * ac.y, zx = ab.z * ac.x, xz = ab.x * ac.z, xy = ab.x * ac.y,
               yx = ab.y * ac.x;
  const double value = (yz - zy) * ad.x + (zx - xz) * ad.y + (xy - yx) * ad.z;
  const double permanent = (std::abs(yz) + std::abs(zy)) * std::abs(ad.x) +
                           (std::abs(zx) + std::abs(xz)) * std::abs(ad.y) +
                           (std::abs(xy) + std::abs(yx)) * std::abs(ad.z);
  const double bound = (7 + 56 * detail::half_ulp) * detail::half_ulp * permanent;
  return std::abs(value) > bound ? value : detail::orient3d_exact(a, b, c, d);
}

/// Positive when d lies inside the circle through a, b, c (counter-clockwise), zero when on it, exactly.
inline double in_circle(vec2 a, vec2 b, vec2 c, vec2 d) {
  const vec2 ad = a - d, bd = b - d, cd = c - d;
  const double bc = bd.x * cd.y, cb = bd.y * cd.x, ca = cd.x * ad.y, ac = cd.y * ad.x, ab = ad.x * bd.y,
               ba = ad.y * bd.x;
  const double a_lift = dot(ad, ad), b_lift = dot(bd, bd), c_lift = dot(cd, cd);
  const double value = a_lift * (bc - cb) + b_lift * (ca - ac) + c_lift * (ab - ba);
  const double permanent = a_lift * (std::abs(bc) + std::abs(cb)) + b_lift * (std::abs(ca) + std::abs(ac)) +
                           c_lift * (std::abs(ab) + std::abs(ba));
  const double bound = (10 + 96 * detail::half_ulp) * detail::half_ulp * permanent;
  return std::abs(value) > bound ? value : detail::in_circle_exact(a, b, c, d);
}

} // namespace dovetail
