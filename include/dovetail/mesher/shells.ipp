/// @file
/// What `shells.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/shells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<std::vector<simplex<2>>>
edge_connected_shells(std::span<const simplex<2>> triangles, std::size_t point_count) {
  std::vector<std::size_t> root(triangles.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t t) {
    while (root[t] != t)
      t = root[t] = root[root[t]];
    return t;
  };
  const auto edges = build_sides<2>(triangles, point_count);
  for (std::size_t s = 0; s < edges.size(); ++s) {
    const auto members = edges.all_elements(static_cast<local_id>(s));
    for (const local_id t : members) {
      const std::size_t a = find(static_cast<std::size_t>(members[0]));
      const std::size_t b = find(static_cast<std::size_t>(t));
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::vector<simplex<2>>> shells;
  std::vector<std::size_t> shell_of(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (find(t) == t) {
      shell_of[t] = shells.size();
      shells.emplace_back();
    }
    shells[shell_of[find(t)]].push_back(triangles[t]);
  }
  return shells;
}

DOVETAIL_INLINE double winding_number(std::span<const vec3> points, std::span<const simplex<2>> shell,
                                      vec3 p) {
  double angle = 0;
  for (const auto& t : shell) {
    const vec3 a = points[t[0]] - p;
    const vec3 b = points[t[1]] - p;
    const vec3 c = points[t[2]] - p;
    const double la = norm(a);
    const double lb = norm(b);
    const double lc = norm(c);
    angle +=
        2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

DOVETAIL_INLINE std::vector<bounded_body> bodies_of(const simplicial_mesh<2>& boundary) {
  std::vector<bounded_body> bodies;
  std::vector<double> volumes;
  std::vector<std::vector<simplex<2>>> voids;
  for (auto& shell : edge_connected_shells(boundary.elements, boundary.points.size())) {
    const double volume = enclosed_volume(boundary.points, shell);
    if (volume > 0) {
      bodies.push_back({std::move(shell), {}});
      volumes.push_back(volume);
    } else {
      voids.push_back(std::move(shell));
    }
  }
  for (auto& shell : voids) {
    const auto& t = shell.front();
    const auto at = [&](std::size_t k) { return boundary.points[t[k]]; };
    const vec3 inside = (at(0) + at(1) + at(2)) / 3.0; // not a vertex: shells may touch there
    std::size_t best = bodies.size();
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if ((best == bodies.size() || volumes[b] < volumes[best]) &&
          winding_number(boundary.points, bodies[b].outer, inside) > 0.5)
        best = b;
    if (best == bodies.size())
      throw mesher_error("a shell of " + std::to_string(shell.size()) +
                         " boundary triangles faces inwards but lies in no other; check its orientation");
    bodies[best].voids.push_back(std::move(shell));
  }
  return bodies;
}

} // namespace dovetail
