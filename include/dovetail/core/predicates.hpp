/// @file
/// Orientation, in-circle and in-sphere tests with the exact sign: a floating-point filter, then integers of
/// some words where the differences of coordinates are multiples of a common unit (nearly always), then exact
/// expansions.
///
/// The filters' error bounds and the arithmetic of expansions are those of J. R. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", doi 10.1007/PL00009321. Exact
/// as long as no intermediate product over- or underflows.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "dovetail needs IEEE arithmetic: compile without -ffast-math and its parts (docs/building.md)"
#endif

#include "dovetail/core/fixed_integer.hpp"
#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dovetail {

namespace detail {

/// No more terms than this can be free of overlap: doubles have so many different exponents.
inline constexpr std::size_t most_terms = 2100;

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
auto operator*(const expansion<A>& a, const expansion<B>& b) {
  expansion<std::min(2 * A * B, most_terms)> result;
  for (std::size_t i = 0; i < a.size; ++i)
    for (std::size_t j = 0; j < b.size; ++j)
      add_product(result, a.terms[i], b.terms[j]);
  return result;
}

template <std::size_t A, std::size_t B>
auto operator+(const expansion<A>& a, const expansion<B>& b) {
  expansion<std::min(A + B, most_terms)> result;
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

template <std::size_t A, std::size_t B>
auto operator-(const expansion<A>& a, const expansion<B>& b) {
  return a + -b;
}

inline expansion<2> exact_difference(double a, double b) {
  expansion<2> result;
  result.add(a);
  result.add(-b);
  return result;
}

inline constexpr double half_ulp = std::numeric_limits<double>::epsilon() / 2;

/// The determinants, of doubles, of expansions or of integers of some words.
template <class Number>
[[gnu::always_inline]] inline auto plane_determinant(const std::array<Number, 4>& n) {
  const auto& [bx, by, cx, cy] = n;
  return bx * cy - by * cx;
}
template <class Number>
[[gnu::always_inline]] inline auto space_determinant(const std::array<Number, 9>& n) {
  const auto& [bx, by, bz, cx, cy, cz, dx, dy, dz] = n;
  return (by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy + (bx * cy - by * cx) * dz;
}
template <class Number>
[[gnu::always_inline]] inline auto circle_determinant(const std::array<Number, 6>& n) {
  const auto& [ax, ay, bx, by, cx, cy] = n;
  return (ax * ax + ay * ay) * (bx * cy - by * cx) + (bx * bx + by * by) * (cx * ay - cy * ax) +
         (cx * cx + cy * cy) * (ax * by - ay * bx);
}
template <class Number>
[[gnu::always_inline]] inline auto sphere_determinant(const std::array<Number, 12>& n) {
  const auto& [ax, ay, az, bx, by, bz, cx, cy, cz, dx, dy, dz] = n;
  const auto ab = ax * by - bx * ay, bc = bx * cy - cx * by, cd = cx * dy - dx * cy, da = dx * ay - ax * dy,
             ac = ax * cy - cx * ay, bd = bx * dy - dx * by;
  const auto abc = az * bc - bz * ac + cz * ab, bcd = bz * cd - cz * bd + dz * bc,
             cda = cz * da + dz * ac + az * cd, dab = dz * ab + az * bd + bz * da;
  const auto a_lift = ax * ax + ay * ay + az * az, b_lift = bx * bx + by * by + bz * bz,
             c_lift = cx * cx + cy * cy + cz * cz, d_lift = dx * dx + dy * dy + dz * dz;
  return (a_lift * bcd - b_lift * cda) + (c_lift * dab - d_lift * abc);
}

/// As `exact_sign`, for what is no multiple of a common unit. Not inlined: it needs much of the stack.
template <std::size_t N, class Determinant>
[[gnu::noinline]] double sign_by_expansions(const std::array<double, N>& a, const std::array<double, N>& b,
                                            const Determinant& determinant) {
  std::array<expansion<2>, N> expansions;
  for (std::size_t i = 0; i < N; ++i)
    expansions[i] = exact_difference(a[i], b[i]);
  return determinant(expansions).sign();
}

/// The exact sign of a determinant of the differences a[i] - b[i].
template <std::size_t N, class Determinant>
double exact_sign(const std::array<double, N>& a, const std::array<double, N>& b,
                  const Determinant& determinant) {
  std::array<fixed_integer<1>, N> integers;
  if (integer_differences(a, b, integers))
    return determinant(integers).sign();
  std::array<fixed_integer<2>, N> wider_integers;
  if (integer_differences(a, b, wider_integers))
    return determinant(wider_integers).sign();
  return sign_by_expansions(a, b, determinant);
}

double orient2d_exact(vec2 a, vec2 b, vec2 c);

double orient3d_exact(vec3 a, vec3 b, vec3 c, vec3 d);

double in_circle_exact(vec2 a, vec2 b, vec2 c, vec2 d);

double in_sphere_exact(vec3 a, vec3 b, vec3 c, vec3 d, vec3 e);

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

/// Positive when e lies inside the sphere through a, b, c, d (a positively oriented tetrahedron), zero when
/// on it, exactly.
inline double in_sphere(vec3 a, vec3 b, vec3 c, vec3 d, vec3 e) {
  const vec3 ae = a - e, be = b - e, ce = c - e, de = d - e;
  const double value = detail::sphere_determinant<double>(
      {ae.x, ae.y, ae.z, be.x, be.y, be.z, ce.x, ce.y, ce.z, de.x, de.y, de.z});
  const auto crossed = [](vec3 p, vec3 q) { return std::abs(p.x * q.y) + std::abs(q.x * p.y); };
  const double ab = crossed(ae, be), bc = crossed(be, ce), cd = crossed(ce, de), da = crossed(de, ae),
               ac = crossed(ae, ce), bd = crossed(be, de);
  const double az = std::abs(ae.z), bz = std::abs(be.z), cz = std::abs(ce.z), dz = std::abs(de.z);
  const double permanent =
      (cd * bz + bd * cz + bc * dz) * dot(ae, ae) + (da * cz + ac * dz + cd * az) * dot(be, be) +
      (ab * dz + bd * az + da * bz) * dot(ce, ce) + (bc * az + ac * bz + ab * cz) * dot(de, de);
  const double bound = (16 + 224 * detail::half_ulp) * detail::half_ulp * permanent;
  return std::abs(value) > bound ? value : detail::in_sphere_exact(a, b, c, d, e);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/predicates.ipp"
#endif
