/// @file
/// A full check of what fills a boundary, by another way than that of the library's own checks.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/mesher/checks.hpp"
#include "mesher/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace random_pieces {

using dovetail::simplex;
using dovetail::vec3;
using shapes::surface;

/// Empty when elements fill the boundary: all positive, fitting together side to side, every given triangle a
/// side as it is oriented and no other side without a neighbour, given points as they were, and the volume.
inline std::string fault_of(const surface& boundary, const dovetail::simplicial_mesh<3>& mesh) {
  if (mesh.points.size() < boundary.points.size() ||
      !std::equal(boundary.points.begin(), boundary.points.end(), mesh.points.begin()))
    return "points have changed";
  std::vector<std::pair<simplex<2>, int>> sides; // as sorted; how often in this direction less in the other
  const auto add = [&](simplex<2> t, int sign) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k + 1 < 3; ++k)
        if (t[k] > t[k + 1]) {
          std::swap(t[k], t[k + 1]);
          sign = -sign;
        }
    sides.push_back({t, sign});
  };
  double volume = 0;
  for (const auto& e : mesh.elements) {
    std::array<vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k)
      p[k] = mesh.points[e[k]];
    if (!(dovetail::orient3d(p[0], p[1], p[2], p[3]) > 0))
      return "an element is not positive";
    volume += dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) / 6;
    for (const auto& local : dovetail::numbering::sides<3>)
      add({e[local[0]], e[local[1]], e[local[2]]}, 1);
  }
  std::sort(sides.begin(), sides.end());
  const auto count = [&](const std::pair<simplex<2>, int>& side) {
    const auto [first, last] = std::equal_range(sides.begin(), sides.end(), side);
    return last - first;
  };
  std::vector<std::pair<simplex<2>, int>> given;
  {
    auto of_elements = std::move(sides);
    sides.clear();
    for (const auto& t : boundary.elements)
      add(t, 1);
    given = std::move(sides);
    sides = std::move(of_elements);
  }
  std::sort(given.begin(), given.end());
  for (const auto& side : given)
    if (count(side) != 1)
      return "a given triangle is not a side of one element";
  for (const auto& side : sides) {
    if (count(side) != 1)
      return "two elements lie on the same side of a triangle";
    const std::pair<simplex<2>, int> reverse{side.first, -side.second};
    const bool is_given = std::binary_search(given.begin(), given.end(), side);
    const bool both = std::binary_search(given.begin(), given.end(), reverse);
    if (count(reverse) != (is_given && !both ? 0 : 1))
      return "a side has no neighbour or one across the boundary";
  }
  const double expected = dovetail::enclosed_volume(boundary.points, boundary.elements);
  double extent = 0;
  for (const vec3 p : boundary.points)
    extent = std::max(extent, distance(p, boundary.points.front()));
  const double rounding = 1e-13 * extent * extent * extent;
  if (std::abs(volume - expected) > 1e-9 * expected + rounding)
    return "the volume is " + std::to_string(volume) + ", not " + std::to_string(expected);
  return "";
}

} // namespace random_pieces
