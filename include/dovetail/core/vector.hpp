/// @file
/// Points and vectors of the plane and of 3-space: aggregates without hidden state.
#pragma once

#include <array>
#include <cmath>

namespace dovetail {

/// A point or vector of the plane; also a parameter pair (u, v) of a surface.
struct vec2 {
  double x = 0; ///< along the first axis; the parameter u
  double y = 0; ///< along the second axis; the parameter v

  friend constexpr bool operator==(const vec2&, const vec2&) = default;
  friend constexpr vec2 operator+(vec2 a, vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr vec2 operator-(vec2 a, vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr vec2 operator*(double s, vec2 a) { return {s * a.x, s * a.y}; }
};

/// A point or vector of 3-space.
struct vec3 {
  double x = 0; ///< along the first axis
  double y = 0; ///< along the second axis
  double z = 0; ///< along the third axis

  constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  constexpr vec3& operator+=(vec3 b) { return x += b.x, y += b.y, z += b.z, *this; } ///< adds `b` to it
  /// Subtracts `b` from it.
  constexpr vec3& operator-=(vec3 b) { return x -= b.x, y -= b.y, z -= b.z, *this; }

  friend constexpr bool operator==(const vec3&, const vec3&) = default;
  friend constexpr vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr vec3 operator-(vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr vec3 operator*(double s, vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr vec3 operator/(vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
};

/// The scalar product.
constexpr double dot(vec2 a, vec2 b) {
  return a.x * b.x + a.y * b.y;
}
/// The z component of the vector product; in 3-space the vector product.
constexpr double cross(vec2 a, vec2 b) {
  return a.x * b.y - a.y * b.x;
}
/// The Euclidean length.
inline double norm(vec2 a) {
  return std::sqrt(dot(a, a));
}

constexpr double dot(vec3 a, vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr vec3 cross(vec3 a, vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The square of the Euclidean length.
constexpr double norm_squared(vec3 a) {
  return dot(a, a);
}
inline double norm(vec3 a) {
  return std::sqrt(dot(a, a));
}
inline double distance(vec3 a, vec3 b) {
  return norm(b - a);
}
/// The unit vector along `a`; the zero vector stays zero.
inline vec3 normalized(vec3 a) {
  const double length = norm(a);
  return length > 0 ? a / length : a;
}
/// Angle between two vectors in radians, in [0, pi]; accurate for small angles too.
inline double angle_between(vec3 a, vec3 b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}
/// The point halfway between two points.
constexpr vec3 midpoint(vec3 a, vec3 b) {
  return 0.5 * (a + b);
}
/// Six times this is the determinant of the edge vectors; positive when d sees a, b, c counter-clockwise
/// from outside, that is for a positively oriented tetrahedron (a, b, c, d): (b-a) x (c-a) points to d.
constexpr double signed_volume(vec3 a, vec3 b, vec3 c, vec3 d) {
  return dot(cross(b - a, c - a), d - a) / 6.0;
}

/// Axis-aligned box; empty when any lower bound exceeds its upper bound.
struct box3 {
  vec3 lower{1e300, 1e300, 1e300};    ///< the smallest x, y, z
  vec3 upper{-1e300, -1e300, -1e300}; ///< the largest x, y, z

  /// Makes the box as large as to contain `p`.
  void include(vec3 p) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = p[k] < lower[k] ? p[k] : lower[k];
      upper[k] = p[k] > upper[k] ? p[k] : upper[k];
    }
  }
  bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
  /// The length of the diagonal, 0 when empty.
  double diagonal() const { return empty() ? 0.0 : distance(lower, upper); }
  constexpr vec3 center() const { return midpoint(lower, upper); } ///< the point in the middle
  /// Whether they have a point in common; touching counts.
  bool overlaps(const box3& other) const {
    for (int k = 0; k < 3; ++k)
      if (upper[k] < other.lower[k] || other.upper[k] < lower[k])
        return false;
    return true;
  }
};

/// The box grown by `margin` on every side.
inline box3 inflated(const box3& box, double margin) {
  const vec3 by{margin, margin, margin};
  return {box.lower - by, box.upper + by};
}

} // namespace dovetail
