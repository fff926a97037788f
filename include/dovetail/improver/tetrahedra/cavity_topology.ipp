/// @file
/// What `cavity_topology.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/improver/tetrahedra/cavity_topology.hpp"
#include "dovetail/improver/tetrahedra/tet_walks.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace dovetail::improvement::detail {

/// Parts sides that are there once from those that are there twice; false when one is there more often.
inline bool part_outer_from_inner(const side_list& sides, side_list& outer, side_list& inner) {
  outer.size = inner.size = 0;
  for (int i = 0, end = 0; i < sides.size; i = end) {
    for (end = i + 1; end < sides.size && sides[end] == sides[i];)
      ++end;
    if (end - i > 2)
      return false;
    (end - i == 1 ? outer : inner).push(sides[i]);
  }
  return true;
}

/// The sides form one sphere: each edge is in two of them, they hang together, and by Euler's formula there
/// is no handle and no two parts touch at a vertex only.
inline bool is_sphere(side_list sides) {
  bounded_list<local_id, 12 * max_cavity> corners;
  bounded_list<std::array<local_id, 2>, 12 * max_cavity> edges;
  for (const auto& [a, b, c] : sides) {
    for (const local_id v : {a, b, c})
      corners.push(v);
    edges.push({a, b});
    edges.push({a, c});
    edges.push({b, c});
  }
  std::sort(corners.begin(), corners.end());
  std::sort(edges.begin(), edges.end());
  for (int i = 0; i < edges.size; i += 2)
    if (i + 1 == edges.size || edges[i] != edges[i + 1] || (i > 0 && edges[i] == edges[i - 1]))
      return false;
  const auto vertices = static_cast<int>(std::unique(corners.begin(), corners.end()) - corners.begin());
  if (vertices - edges.size / 2 + sides.size != 2)
    return false;
  // What is reached from the first side is moved to the front.
  const auto are_neighbours = [](const side_key& one, const side_key& other) {
    return std::count_if(one.begin(), one.end(), [&](local_id v) {
             return std::find(other.begin(), other.end(), v) != other.end();
           }) == 2;
  };
  int reached = 1;
  for (int i = 0; i < reached; ++i)
    for (int j = reached; j < sides.size; ++j)
      if (are_neighbours(sides[i], sides[j]))
        std::swap(sides[j], sides[reached++]);
  return reached == sides.size;
}

/// Some element that is not in `old` has these three vertices. Starts at the first one's star, without marks.
inline bool is_side_elsewhere(const tet_complex& mesh, const side_key& side, std::span<const local_id> old) {
  if (!mesh.is_used(side[0]))
    return false;
  const auto has_side = [&](local_id e) {
    const auto& v = mesh.vertices(e);
    return std::all_of(side.begin(), side.end(),
                       [&v](local_id s) { return std::find(v.begin(), v.end(), s) != v.end(); });
  };
  bounded_list<local_id, 4 * max_star> star;
  star.push(mesh.element_at(side[0]));
  for (int k = 0; k < star.size; ++k) {
    if (std::find(old.begin(), old.end(), star[k]) == old.end() && has_side(star[k]))
      return true;
    for (int s = 0; s < 4; ++s) {
      const half_side beyond = mesh.across(star[k], s);
      if (mesh.vertex(star[k], s) != side[0] && beyond != no_id &&
          std::find(star.begin(), star.end(), element_of(beyond)) == star.end() &&
          !star.push(element_of(beyond)))
        return true; // too many to be sure
    }
  }
  return false;
}

} // namespace dovetail::improvement::detail

namespace dovetail::improvement {

DOVETAIL_INLINE bool fills_a_ball(const tet_complex& mesh, std::span<const local_id> old,
                                  std::span<const simplex<3>> fresh) {
  for (const auto& v : fresh)
    if (v[0] == v[1] || v[0] == v[2] || v[0] == v[3] || v[1] == v[2] || v[1] == v[3] || v[2] == v[3])
      return false;
  bounded_list<simplex<3>, max_cavity> removed;
  for (const local_id e : old)
    removed.push(mesh.vertices(e));
  detail::side_list outline, inner_of_old, outline_of_fresh, inner;
  return !detail::has_fixed_side_within(mesh, old) &&
         detail::part_outer_from_inner(detail::sorted_sides(removed), outline, inner_of_old) &&
         detail::part_outer_from_inner(detail::sorted_sides(fresh), outline_of_fresh, inner) &&
         std::equal(outline.begin(), outline.end(), outline_of_fresh.begin(), outline_of_fresh.end()) &&
         detail::is_sphere(outline) && std::none_of(inner.begin(), inner.end(), [&](const auto& side) {
           return detail::is_side_elsewhere(mesh, side, old);
         });
}

} // namespace dovetail::improvement
