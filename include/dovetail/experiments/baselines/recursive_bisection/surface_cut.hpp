/// @file
/// The first half of a bi-division: the triangles of a closed surface on two sides of a plane, and the loops
/// of edges between them.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dovetail::baselines {

/// A plane by its normal, of length 1, and its distance from the origin along it.
struct cut_plane {
  vec3 normal;       ///< of length 1
  double offset = 0; ///< from the origin, along the normal
};

/// A closed surface in two parts. `loops` are the edges between them, each with what is below on its right:
/// seen from above, they run around the cut as its boundary does.
struct surface_cut {
  std::vector<std::uint8_t> above; ///< per triangle
  std::vector<std::array<local_id, 2>> loops;
  std::vector<std::array<local_id, 2>> beside; ///< per edge of a loop: the triangles below and above
  bool simple = false;                         ///< no loop comes to a point twice, nor two to one point
};

/// The mean of a triangle's corners.
inline vec3 centre_of_triangle(const simplicial_mesh<2>& mesh, std::size_t t) {
  vec3 sum{};
  for (const local_id v : mesh.elements[t])
    sum += mesh.points[v];
  return sum / 3.0;
}

namespace detail {

/// A triangle with two edges on a loop changes its side: the loop gets shorter, so that this ends.
inline void smooth_loops(const side_table<2>& table, std::vector<std::uint8_t>& above) {
  std::vector<local_id> queue(above.size());
  for (std::size_t t = 0; t < above.size(); ++t)
    queue[t] = static_cast<local_id>(t);
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const auto t = static_cast<std::size_t>(queue[k]);
    int others = 0;
    for (const local_id side : table.of_element[t])
      if (const local_id next = table.across(side, queue[k]); next != no_id)
        others += above[next] != above[t] ? 1 : 0;
    if (others < 2)
      continue;
    above[t] = above[t] == 0 ? 1 : 0;
    for (const local_id side : table.of_element[t])
      if (const local_id next = table.across(side, static_cast<local_id>(t)); next != no_id)
        queue.push_back(next);
  }
}

inline void find_loops(const simplicial_mesh<2>& surface, const side_table<2>& table, surface_cut& cut) {
  cut.loops.clear();
  cut.beside.clear();
  for (std::size_t s = 0; s < table.size(); ++s) {
    auto [below, above] = table.elements[s];
    if (!table.is_interior(static_cast<local_id>(s)) || cut.above[below] == cut.above[above])
      continue;
    if (cut.above[below] != 0)
      std::swap(below, above);
    cut.loops.push_back(side_of_element(surface, table, static_cast<local_id>(s), above));
    cut.beside.push_back({below, above});
  }
}

/// The points that loops leave more than once, growing.
inline std::vector<local_id> pinched_points(const surface_cut& cut) {
  std::vector<local_id> starts, pinched;
  for (const auto& edge : cut.loops)
    starts.push_back(edge[0]);
  sort_all(starts);
  for (std::size_t k = 1; k < starts.size(); ++k)
    if (starts[k] == starts[k - 1])
      pinched.push_back(starts[k]);
  sort_unique(pinched);
  return pinched;
}

} // namespace detail

/// Cuts a closed surface without edges of more than two triangles: what has its centre below the plane from
/// what has it above, with loops that are smoothed. Where two loops meet, all triangles at the point come
/// to the side below, in a few rounds. Linear in the triangles, as long as smoothing is local.
inline surface_cut cut_surface(const simplicial_mesh<2>& surface, const side_table<2>& table,
                               const cut_plane& plane) {
  surface_cut cut;
  for (std::size_t t = 0; t < surface.elements.size(); ++t)
    cut.above.push_back(dot(centre_of_triangle(surface, t), plane.normal) > plane.offset ? 1 : 0);
  for (int round = 0; round < 8 && !cut.simple; ++round) {
    detail::smooth_loops(table, cut.above);
    detail::find_loops(surface, table, cut);
    const auto pinched = detail::pinched_points(cut);
    cut.simple = pinched.empty();
    if (!cut.simple)
      for (std::size_t t = 0; t < surface.elements.size(); ++t)
        for (const local_id v : surface.elements[t])
          if (std::binary_search(pinched.begin(), pinched.end(), v))
            cut.above[t] = 0;
  }
  return cut;
}

} // namespace dovetail::baselines
