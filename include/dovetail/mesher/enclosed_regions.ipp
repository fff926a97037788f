/// @file
/// What `enclosed_regions.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/enclosed_regions.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// `half_turn`: where the third corner is, from the direction of the first triangle's: 0 in that direction, 1
/// before and 3 after the opposite one, which is 2.
struct enclosed_regions::edge_side {
  std::uint32_t triangle;
  bool along; ///< whether the triangle passes the edge from its lower end
  vec3 apex;
  int half_turn;
};

namespace detail {

/// Of two points in a plane with an edge: are they on the same side of it? Exact.
inline bool same_side(vec3 a, vec3 b, vec3 p, vec3 q) {
  for (int k = 0; k < 3; ++k) {
    const auto flat = [&](vec3 v) { return vec2{v[(k + 1) % 3], v[(k + 2) % 3]}; };
    const double of_p = orient2d(flat(a), flat(b), flat(p));
    if (of_p != 0)
      return (of_p > 0) == (orient2d(flat(a), flat(b), flat(q)) > 0);
  }
  return true; // all on one line
}

} // namespace detail

DOVETAIL_INLINE enclosed_regions::enclosed_regions(const simplicial_mesh<2>& surface) : surface_(surface) {
  join_across_edges();
  std::vector<box3> boxes;
  boxes.reserve(surface.elements.size());
  for (std::size_t t = 0; t < surface.elements.size(); ++t) {
    box3& box = boxes.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      box.include(corner(t, k));
  }
  tree_ = box_tree(boxes);
  measure_shells();
  number_regions();
}

DOVETAIL_INLINE vec3 enclosed_regions::corner(std::size_t triangle, std::size_t k) const {
  return surface_.points[surface_.elements[triangle][k]];
}

/// Around an edge, seen from its lower end to its upper one and counter-clockwise, each triangle faces the
/// next one.
DOVETAIL_INLINE void enclosed_regions::join_across_edges() {
  const auto& triangles = surface_.elements;
  disjoint_sets sides(2 * triangles.size()), components(triangles.size());
  std::vector<edge_side> around;
  const auto key_of = [&](std::size_t i) {
    const auto& t = triangles[i / 3];
    return sorted_vertices(simplex<1>{t[(i + 1) % 3], t[(i + 2) % 3]});
  };
  for_each_group<2>(
      3 * triangles.size(), surface_.points.size(), key_of,
      [&](const simplex<1>& edge, std::span<const std::uint32_t> members) {
        const vec3 a = surface_.points[edge[0]];
        const vec3 b = surface_.points[edge[1]];
        if (members.size() < 2)
          throw geometry_error("the edge from " + place_text(a) + " to " + place_text(b) +
                               " has one triangle only; close the surface there");
        around.clear();
        for (const std::uint32_t i : members)
          around.push_back({i / 3, triangles[i / 3][(i + 1) % 3] == edge[0], corner(i / 3, i % 3), 0});
        if (around.size() > 2) {
          const vec3 first = around.front().apex;
          for (edge_side& s : around) {
            const double turn = orient3d(a, b, first, s.apex);
            s.half_turn = turn > 0 ? 1 : turn < 0 ? 3 : detail::same_side(a, b, first, s.apex) ? 0 : 2;
          }
          std::sort(around.begin(), around.end(), [&](const edge_side& x, const edge_side& y) {
            return x.half_turn != y.half_turn ? x.half_turn < y.half_turn
                                              : orient3d(a, b, x.apex, y.apex) > 0;
          });
          for (std::size_t k = 1; k < around.size(); ++k)
            if (around[k].half_turn == around[k - 1].half_turn &&
                !(orient3d(a, b, around[k - 1].apex, around[k].apex) > 0))
              throw geometry_error("triangles " + std::to_string(around[k - 1].triangle) + " and " +
                                   std::to_string(around[k].triangle) +
                                   " lie upon each other at the edge from " + place_text(a) + " to " +
                                   place_text(b) + "; remove one of them");
        }
        for (std::size_t k = 0; k < around.size(); ++k) {
          const edge_side& here = around[k];
          const edge_side& next = around[(k + 1) % around.size()];
          // The normal of one that passes the edge from its lower end points counter-clockwise.
          sides.unite(static_cast<local_id>(2 * here.triangle + (here.along ? 1 : 0)),
                      static_cast<local_id>(2 * next.triangle + (next.along ? 0 : 1)));
          components.unite(static_cast<local_id>(here.triangle), static_cast<local_id>(next.triangle));
        }
      });
  auto shells = sides.number_sets();
  shell_.resize(triangles.size());
  first_triangle_.assign(static_cast<std::size_t>(shells.count), no_id);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t s = 0; s < 2; ++s) {
      shell_[t][s] = shells.of_member[2 * t + s];
      local_id& first = first_triangle_[shell_[t][s]];
      if (first == no_id)
        first = static_cast<local_id>(t);
    }
  component_ = std::move(components.number_sets().of_member);
}

DOVETAIL_INLINE void enclosed_regions::measure_shells() {
  volume_.assign(first_triangle_.size(), 0);
  constexpr local_id of_several = -2;
  only_component_.assign(surface_.points.size(), no_id);
  for (std::size_t t = 0; t < shell_.size(); ++t) {
    for (const local_id v : surface_.elements[t]) {
      local_id& known = only_component_[v];
      known = known == no_id || known == component_[t] ? component_[t] : of_several;
    }
    if (shell_[t][0] == shell_[t][1])
      continue; // it adds as much as it takes away
    for (std::size_t s = 0; s < 2; ++s) {
      const auto shell = static_cast<std::size_t>(shell_[t][s]);
      // From a point of the shell itself, so that nothing is lost where it is small and far away.
      const vec3 origin = corner(static_cast<std::size_t>(first_triangle_[shell]), 0);
      const double volume = signed_volume(origin, corner(t, 0), corner(t, 1), corner(t, 2));
      volume_[shell] += s == 0 ? volume : -volume;
    }
  }
  for (local_id& component : only_component_)
    component = component == of_several ? no_id : component;
}

/// A shell that encloses something is a region; any other one lies in the region around it.
DOVETAIL_INLINE void enclosed_regions::number_regions() {
  region_of_shell_.assign(volume_.size(), no_id);
  std::size_t others = 0;
  for (std::size_t shell = 0; shell < volume_.size(); ++shell)
    if (volume_[shell] > 0)
      region_of_shell_[shell] = count_++; // shells are in the order of their first triangles
    else
      ++others;
  if (others > 1) {
    std::vector<local_id> around(volume_.size(), no_id);
    for (std::size_t shell = 0; shell < volume_.size(); ++shell)
      if (!(volume_[shell] > 0))
        around[shell] =
            region_around(point_of_shell(static_cast<local_id>(shell)), component_[first_triangle_[shell]]);
    for (std::size_t shell = 0; shell < volume_.size(); ++shell)
      if (!(volume_[shell] > 0))
        region_of_shell_[shell] = around[shell];
  }
  beside_.resize(shell_.size());
  for (std::size_t t = 0; t < shell_.size(); ++t)
    for (std::size_t s = 0; s < 2; ++s)
      beside_[t][s] = region_of_shell_[shell_[t][s]];
}

/// A corner that no other component has, else the middle of a triangle.
DOVETAIL_INLINE vec3 enclosed_regions::point_of_shell(local_id shell) const {
  const auto first = static_cast<std::size_t>(first_triangle_[shell]);
  for (std::size_t k = 0; k < 3; ++k)
    if (only_component_[surface_.elements[first][k]] != no_id)
      return corner(first, k);
  return (corner(first, 0) + corner(first, 1) + corner(first, 2)) / 3.0;
}

/// Shells wind once around what they enclose: counted along a ray from p, without the triangles of one
/// component. Of those that wind around p the smallest is the one around it.
DOVETAIL_INLINE local_id enclosed_regions::region_around(vec3 p, local_id component) const {
  std::vector<std::pair<local_id, int>> winding;
  tree_.for_each(
      [&](const box3& box, std::size_t) {
        return p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z &&
               p.z <= box.upper.z;
      },
      [&](local_id triangle) {
        const auto t = static_cast<std::size_t>(triangle);
        if (component_[t] == component)
          return;
        if (const int passed = passes(t, p); passed != 0 && shell_[t][0] != shell_[t][1]) {
          winding.emplace_back(shell_[t][0], passed);
          winding.emplace_back(shell_[t][1], -passed);
        }
      });
  std::sort(winding.begin(), winding.end());
  std::size_t best = volume_.size();
  for (std::size_t i = 0; i < winding.size();) {
    const local_id shell = winding[i].first;
    int sum = 0;
    for (; i < winding.size() && winding[i].first == shell; ++i)
      sum += winding[i].second;
    const auto candidate = static_cast<std::size_t>(shell);
    if (sum == 1 && volume_[candidate] > 0 && (best == volume_.size() || volume_[candidate] < volume_[best]))
      best = candidate;
  }
  return best == volume_.size() ? no_id : region_of_shell_[best];
}

/// Does a ray from p towards growing x pass the triangle: 1 when it leaves through it, -1 when it enters. The
/// ray is moved by an infinitely small step in y and by a smaller one in z, so that it meets no edge.
DOVETAIL_INLINE int enclosed_regions::passes(std::size_t triangle, vec3 p) const {
  const auto left_of = [&](vec3 a, vec3 b) {
    const double turn = orient2d({a.y, a.z}, {b.y, b.z}, {p.y, p.z});
    return turn != 0 ? turn : a.z != b.z ? a.z - b.z : b.y - a.y;
  };
  const std::array<vec3, 3> c{corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
  const double turns[3] = {left_of(c[0], c[1]), left_of(c[1], c[2]), left_of(c[2], c[0])};
  const bool inside = turns[0] > 0 && turns[1] > 0 && turns[2] > 0;
  const bool inside_turned = turns[0] < 0 && turns[1] < 0 && turns[2] < 0;
  if (!inside && !inside_turned)
    return 0;
  // Seen against the ray the corners turn left where the normal points along it; p is behind it then.
  const double before = orient3d(c[0], c[1], c[2], p);
  return inside ? (before < 0 ? 1 : 0) : (before > 0 ? -1 : 0);
}

} // namespace dovetail
