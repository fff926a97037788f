/// @file
/// Does a triangulated surface cross itself?
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/mesh/triangle_intersection.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// A point as text, for messages.
inline std::string place(vec3 p) {
  return place_text(p);
}

/// Throws `geometry_error` naming `name` and the place when two triangles cross. Crossings of slivers, lower
/// than `sliver_height`, which the rounding of a file can fold over their neighbours, are only warned of. O(n
/// log n).
inline void require_no_crossing(const simplicial_mesh<2>& mesh, const std::string& name, double sliver_height,
                                report& repairs) {
  const auto corners = [&](std::size_t t) {
    const auto& v = mesh.elements[t];
    return std::array<vec3, 3>{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
  };
  const auto is_sliver = [&](std::size_t t) {
    const auto [a, b, c] = corners(t);
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    return norm(cross(b - a, c - a)) < sliver_height * longest;
  };
  std::vector<box3> boxes(mesh.elements.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (const vec3& p : corners(t))
      boxes[t].include(p);
  const box_tree tree(boxes);
  std::size_t slivers = 0;
  std::vector<std::pair<std::size_t, std::size_t>> crossing;
  for (std::size_t t = 0; t < boxes.size(); ++t)
    tree.for_each([&](const box3& box, std::size_t) { return box.overlaps(boxes[t]); },
                  [&](local_id id) {
                    const auto other = static_cast<std::size_t>(id);
                    if (other <= t || !boxes[other].overlaps(boxes[t]) ||
                        !triangles_cross(mesh.points, mesh.elements[t], mesh.elements[other]))
                      return;
                    if (is_sliver(t) || is_sliver(other))
                      ++slivers;
                    else
                      crossing.emplace_back(t, other);
                  });
  if (slivers > 0)
    repairs.warnings.push_back(name + ": " + std::to_string(slivers) +
                               " slivers overlap their neighbours by rounding");
  if (crossing.empty())
    return;
  const auto first = *std::min_element(crossing.begin(), crossing.end());
  const auto [a, b, c] = corners(first.first);
  throw geometry_error(name + ": the surface crosses itself: " + std::to_string(crossing.size()) +
                       " pairs of triangles, one near " + place((a + b + c) / 3) + "; repair it");
}

} // namespace dovetail::discrete
