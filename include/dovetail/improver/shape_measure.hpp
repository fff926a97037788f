/// @file
/// Shape measures of a tetrahedron: the objective that the native improver raises.
///
/// A measure is an empty policy with
///   M::of_apex<T>(a, b, c)      value of the tetrahedron (0, a, b, c), T = float or double: at most 1,
///   positive
///                               exactly when it is positively oriented (up to rounding), better when larger
///   M::from_angle(degrees)      the value that stands for "all dihedral angles at least `degrees`"
/// `of_apex` has no branches, so that a loop over a batch of tetrahedra is turned into vector instructions.
/// Models: minimum_dihedral (default), radius_ratio, mean_ratio.
#pragma once

#include "dovetail/core/vector.hpp"

#include <cmath>
#include <concepts>
#include <numbers>

namespace dovetail::improvement {

/// A vector of the number type that a measure is evaluated in.
template <class T>
struct triple {
  T x, y, z; ///< the components

  friend constexpr triple operator-(triple a, triple b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};
/// The vector product.
template <class T>
constexpr triple<T> cross(triple<T> a, triple<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The scalar product.
template <class T>
constexpr T dot(triple<T> a, triple<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

namespace detail {
template <class T>
constexpr T smaller(T a, T b) {
  return a < b ? a : b;
}
template <class T>
constexpr T larger(T a, T b) {
  return a > b ? a : b;
}
/// x |x|: keeps the order of x, and saves the square root when x is a ratio of squares.
template <class T>
constexpr T signed_square(T x) {
  return x * (x < 0 ? -x : x);
}
/// Keeps a division by the square of an area finite; far below any area that matters.
template <class T>
inline constexpr T tiny = T(1e-30);
template <>
inline constexpr double tiny<double> = 1e-200;
} // namespace detail

/// sin^2 of the dihedral angle furthest from a right angle; the largest angle counts for less: an angle
/// of 180 - x is as bad as one of about 0.63 x. Regular tetrahedron 8/9. A value of sin^2(x), x < 90 degrees,
/// says that no dihedral angle is under x. Negative, with the same magnitude, for an inverted element.
struct minimum_dihedral {
  /// How much further from 90 degrees an obtuse angle has to be to count as much as an acute one.
  static constexpr double obtuse_weight = 2.5;

  template <class T>
  static T of_apex(triple<T> a, triple<T> b, triple<T> c) {
    using detail::larger, detail::smaller, detail::signed_square;
    // Inward area vectors of the sides opposite a, b, c; their sum is minus that of the side (a, b, c). The
    // cosine of the angle between two sides is minus that of their vectors, or plus it for the sum.
    const triple<T> na = cross(b, c), nb = cross(c, a), nc = cross(a, b);
    const triple<T> sum{na.x + nb.x + nc.x, na.y + nb.y + nc.y, na.z + nb.z + nc.z};
    const T ra = T(1) / (dot(na, na) + detail::tiny<T>), rb = T(1) / (dot(nb, nb) + detail::tiny<T>);
    const T rc = T(1) / (dot(nc, nc) + detail::tiny<T>), rs = T(1) / (dot(sum, sum) + detail::tiny<T>);
    const T ab = signed_square(-dot(na, nb)) * (ra * rb), bc = signed_square(-dot(nb, nc)) * (rb * rc);
    const T ca = signed_square(-dot(nc, na)) * (rc * ra), as = signed_square(dot(na, sum)) * (ra * rs);
    const T bs = signed_square(dot(nb, sum)) * (rb * rs), cs = signed_square(dot(nc, sum)) * (rc * rs);
    const T most = larger(larger(larger(ab, bc), larger(ca, as)), larger(bs, cs));
    const T least = smaller(smaller(smaller(ab, bc), smaller(ca, as)), smaller(bs, cs));
    const T value = smaller(T(1) - most, T(obtuse_weight) * (T(1) + least));
    return dot(na, a) > 0 ? value : -value;
  }
  static double from_angle(double degrees) {
    const double s = std::sin(degrees * std::numbers::pi / 180);
    return s * s;
  }
};

/// 3 x radius of the inscribed over that of the circumscribed sphere; 1 for the regular tetrahedron.
struct radius_ratio {
  template <class T>
  static T of_apex(triple<T> a, triple<T> b, triple<T> c) {
    const triple<T> na = cross(b, c), nb = cross(c, a), nc = cross(a, b);
    const triple<T> sum{na.x + nb.x + nc.x, na.y + nb.y + nc.y, na.z + nb.z + nc.z};
    const T area =
        std::sqrt(dot(na, na)) + std::sqrt(dot(nb, nb)) + std::sqrt(dot(nc, nc)) + std::sqrt(dot(sum, sum));
    const T determinant = dot(na, a);
    const T a2 = dot(a, a), b2 = dot(b, b), c2 = dot(c, c);
    // |a^2 b x c + b^2 c x a + c^2 a x b| = 2 R determinant; inscribed radius = determinant / area.
    const triple<T> w{a2 * na.x + b2 * nb.x + c2 * nc.x, a2 * na.y + b2 * nb.y + c2 * nc.y,
                      a2 * na.z + b2 * nb.z + c2 * nc.z};
    const T value = T(6) * determinant * determinant / (area * std::sqrt(dot(w, w)) + detail::tiny<T>);
    return determinant > 0 ? value : -value;
  }
  /// A sliver whose dihedral angles are at least x has about this radius ratio.
  static double from_angle(double degrees) { return std::sin(degrees * std::numbers::pi / 180) / 0.9428; }
};

/// Mean ratio, 12 (3 volume)^(2/3) / sum of squared edge lengths, cubed to spare the root; 1 when regular.
struct mean_ratio {
  template <class T>
  static T of_apex(triple<T> a, triple<T> b, triple<T> c) {
    const T determinant = dot(cross(a, b), c);
    const triple<T> ab = b - a, bc = c - b, ca = a - c;
    const T edges = dot(a, a) + dot(b, b) + dot(c, c) + dot(ab, ab) + dot(bc, bc) + dot(ca, ca);
    const T value = T(432) * determinant * determinant / (edges * edges * edges + detail::tiny<T>);
    return determinant > 0 ? value : -value;
  }
  static double from_angle(double degrees) {
    const double ratio = std::sin(degrees * std::numbers::pi / 180) / 0.9428;
    return ratio * ratio;
  }
};

/// Signed volume over the cube of the edges' root mean square length; 1 for the regular tetrahedron. Not a
/// measure of shape: it pulls inverted elements straight towards the right orientation, for untangling.
struct oriented_volume {
  template <class T>
  static T of_apex(triple<T> a, triple<T> b, triple<T> c) {
    const triple<T> ab = b - a, bc = c - b, ca = a - c;
    const T edges = (dot(a, a) + dot(b, b) + dot(c, c) + dot(ab, ab) + dot(bc, bc) + dot(ca, ca)) / T(6) +
                    detail::tiny<T>;
    return T(std::numbers::sqrt2) * dot(cross(a, b), c) / (edges * std::sqrt(edges));
  }
  static double from_angle(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }
};

/// A measure of a tetrahedron's shape, in single and in double precision, that the native improver raises.
///
/// Valid expressions for the class M, edge vectors a, b, c from a vertex as `triple<float>` or
/// `triple<double>`, `double angle` in degrees:
///
/// - `M::of_apex(a, b, c)`: float or double as its arguments
/// - `M::from_angle(angle)`: double
///
/// Semantics: larger is better; positive for a positively oriented element and negative for an inverted one;
/// independent of scale and of which vertex is the apex. `from_angle` is the value to aim at for elements
/// whose smallest dihedral angle is that.
///
/// Complexity: constant, without branches: loops over many apexes are vectorised.
///
/// Failure: none; a flat element has a finite value.
///
/// Models: minimum_dihedral, radius_ratio, mean_ratio, oriented_volume.
template <class M>
concept shape_measure = requires(triple<float> f, triple<double> d, double angle) {
  { M::of_apex(f, f, f) } -> std::same_as<float>;
  { M::of_apex(d, d, d) } -> std::same_as<double>;
  { M::from_angle(angle) } -> std::same_as<double>;
};

/// The measure of the tetrahedron (p, a, b, c), positive for (a-p) x (b-p) . (c-p) > 0.
template <shape_measure Measure>
double measure_of(vec3 p, vec3 a, vec3 b, vec3 c) {
  const auto from_p = [p](vec3 q) { return triple<double>{q.x - p.x, q.y - p.y, q.z - p.z}; };
  return Measure::of_apex(from_p(a), from_p(b), from_p(c));
}

} // namespace dovetail::improvement
