/// @file
/// Closed, oriented boundaries for the contract test of volume meshers.
#pragma once

#include "dovetail/mesher/concepts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace shapes {

using dovetail::local_id;
using dovetail::mesher_input;
using dovetail::vec3;
using triangle = dovetail::simplex<2>;
using surface = dovetail::simplicial_mesh<2>;

inline void append(surface& to, const surface& from, bool inwards = false) {
  const auto offset = static_cast<local_id>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (triangle t : from.elements) {
    if (inwards)
      std::swap(t[1], t[2]);
    to.elements.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
}

/// The boundary of a union of unit cells given by integer corners: every cell face without a neighbour, cut
/// in two triangles; points scaled by `step` from `origin`.
inline surface cells(const std::vector<std::array<int, 3>>& cells, vec3 step, vec3 origin = {}) {
  surface s;
  std::map<std::array<int, 3>, local_id> ids;
  std::map<std::array<int, 3>, bool> inside;
  for (const auto& c : cells)
    inside[c] = true;
  const auto id = [&](std::array<int, 3> c) {
    const auto [it, is_new] = ids.try_emplace(c, static_cast<local_id>(s.points.size()));
    if (is_new)
      s.points.push_back(origin + vec3{c[0] * step.x, c[1] * step.y, c[2] * step.z});
    return it->second;
  };
  for (const auto& c : cells)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int end = 0; end < 2; ++end) {
        auto beyond = c;
        beyond[axis] += end == 0 ? -1 : 1;
        if (inside.count(beyond) != 0)
          continue;
        const auto corner = [&](int u, int v) {
          auto p = c;
          p[axis] += end;
          p[(axis + 1) % 3] += u;
          p[(axis + 2) % 3] += v;
          return id(p);
        };
        std::array<local_id, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        if (end == 0)
          std::swap(q[1], q[3]);
        if ((c[0] + c[1] + c[2]) % 2 == 0) {
          s.elements.push_back({q[0], q[1], q[2]});
          s.elements.push_back({q[0], q[2], q[3]});
        } else {
          s.elements.push_back({q[0], q[1], q[3]});
          s.elements.push_back({q[1], q[2], q[3]});
        }
      }
  return s;
}

/// All cells of a block [lower, upper) for which `keep(x, y, z)` holds.
template <class Keep>
std::vector<std::array<int, 3>> block(std::array<int, 3> lower, std::array<int, 3> upper, Keep keep) {
  std::vector<std::array<int, 3>> result;
  for (int x = lower[0]; x < upper[0]; ++x)
    for (int y = lower[1]; y < upper[1]; ++y)
      for (int z = lower[2]; z < upper[2]; ++z)
        if (keep(x, y, z))
          result.push_back({x, y, z});
  return result;
}
inline std::vector<std::array<int, 3>> block(std::array<int, 3> lower, std::array<int, 3> upper) {
  return block(lower, upper, [](int, int, int) { return true; });
}

/// The unit cube with n x n squares per face.
inline surface cube(int n, double edge = 1, vec3 origin = {}) {
  return cells(block({0, 0, 0}, {n, n, n}), (edge / n) * vec3{1, 1, 1}, origin);
}

/// An icosahedron refined `levels` times, on a sphere.
inline surface sphere(int levels, double radius = 1, vec3 center = {}) {
  const double g = std::numbers::phi;
  surface s;
  s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  s.elements = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::array<local_id, 2>, local_id> middles;
    std::vector<triangle> finer;
    const auto middle = [&](local_id a, local_id b) {
      const auto [it, is_new] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<local_id>(s.points.size()));
      if (is_new)
        s.points.push_back(dovetail::midpoint(s.points[a], s.points[b]));
      return it->second;
    };
    for (const auto& [a, b, c] : s.elements) {
      const local_id ab = middle(a, b);
      const local_id bc = middle(b, c);
      const local_id ca = middle(c, a);
      for (const triangle& t :
           {triangle{a, ab, ca}, triangle{b, bc, ab}, triangle{c, ca, bc}, triangle{ab, bc, ca}})
        finer.push_back(t);
    }
    s.elements = finer;
  }
  for (vec3& p : s.points)
    p = center + radius * dovetail::normalized(p);
  return s;
}

/// A torus around z with n points around the tube and 3 n around the axis.
inline surface torus(int n, double major = 1, double minor = 0.35) {
  surface s;
  const int m = 3 * n;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / m;
      const double v = 2 * std::numbers::pi * j / n;
      const double r = major + minor * std::cos(v);
      s.points.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
    }
  const auto id = [&](int i, int j) { return (i % m) * n + j % n; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      s.elements.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      s.elements.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return s;
}

/// Mean edge length over triangles.
inline double mean_edge(const surface& s) {
  double sum = 0;
  for (const auto& t : s.elements)
    for (std::size_t k = 0; k < 3; ++k)
      sum += dovetail::distance(s.points[t[k]], s.points[t[(k + 1) % 3]]);
  return sum / (3.0 * static_cast<double>(s.elements.size()));
}

} // namespace shapes
