/// @file
/// A quick proof that two triangles of one mesh do not cross, for neighbours in a smooth surface, whose exact
/// test is the most expensive.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace dovetail {

namespace detail {

/// Whether all of `t` but vertices shared with an edge of `s` is beyond that edge, upright on s.
inline bool beyond_an_edge(std::span<const vec3> points, const simplex<2>& s, const simplex<2>& t,
                           double rounding) {
  const auto at = [&](local_id v) { return points[v]; };
  const vec3 normal = cross(at(s[1]) - at(s[0]), at(s[2]) - at(s[0]));
  for (std::size_t k = 0; k < 3; ++k) {
    const local_id from = s[k], to = s[(k + 1) % 3];
    const vec3 along = at(to) - at(from);
    const vec3 outwards = cross(along, normal);
    const double length = norm(outwards);
    // The apex is inside by the triangle's height: what rounding turns is no triangle to decide about.
    if (!(dot(outwards, at(s[(k + 2) % 3]) - at(from)) < -rounding * length))
      return false;
    if (std::all_of(t.begin(), t.end(), [&](local_id v) {
          return v == from || v == to || dot(outwards, at(v) - at(from)) > rounding * length;
        }))
      return true;
  }
  return false;
}

/// Whether all of `t` is on one side of s, along the normal of s.
inline bool beside_its_plane(std::span<const vec3> points, const simplex<2>& s, const simplex<2>& t,
                             double rounding) {
  const auto at = [&](local_id v) { return points[v]; };
  const vec3 normal = cross(at(s[1]) - at(s[0]), at(s[2]) - at(s[0]));
  const auto range = [&](const simplex<2>& triangle) {
    const double a = dot(normal, at(triangle[0]) - at(s[0])), b = dot(normal, at(triangle[1]) - at(s[0])),
                 c = dot(normal, at(triangle[2]) - at(s[0]));
    return std::array<double, 2>{std::min({a, b, c}), std::max({a, b, c})};
  };
  const auto of_s = range(s), of_t = range(t);
  const double margin = rounding * norm(normal);
  return of_t[0] > of_s[1] + margin || of_t[1] < of_s[0] - margin;
}

} // namespace detail

/// True proves that the triangles have nothing in common but the vertices and edges that they share by index:
/// the plane of one separates them, or one upright on it through an edge. False says nothing.
inline bool separated_by_a_plane(std::span<const vec3> points, const simplex<2>& s, const simplex<2>& t) {
  double largest = 0;
  for (const simplex<2>* triangle : {&s, &t})
    for (const local_id v : *triangle)
      for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(points[v][axis]));
  const double rounding = 1e3 * std::numeric_limits<double>::epsilon() * largest;
  return detail::beside_its_plane(points, s, t, rounding) || detail::beyond_an_edge(points, s, t, rounding) ||
         detail::beyond_an_edge(points, t, s, rounding);
}

} // namespace dovetail
