/// @file
/// What `mesh_boundary.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/unused_points.hpp"
#include "dovetail/models/discrete/given_mesh_checks.hpp"
#include "dovetail/models/discrete/mesh_boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The solid of each element, and the material of each solid.
inline std::pair<std::vector<local_id>, std::vector<local_id>> solids_of(const simplicial_mesh<3>& mesh,
                                                                         const side_table<3>& sides) {
  const auto material = [&](std::size_t e) { return mesh.tags.empty() ? 0 : mesh.tags[e]; };
  std::vector<local_id> solid(mesh.elements.size(), no_id);
  std::vector<local_id> materials;
  std::vector<std::size_t> pending;
  for (std::size_t seed = 0; seed < solid.size(); ++seed) {
    if (solid[seed] != no_id)
      continue;
    solid[seed] = static_cast<local_id>(materials.size());
    pending.assign(1, seed);
    while (!pending.empty()) {
      const std::size_t e = pending.back();
      pending.pop_back();
      for (const local_id side : sides.of_element[e]) {
        const local_id other = sides.across(side, static_cast<local_id>(e));
        const auto next = static_cast<std::size_t>(other);
        if (other == no_id || solid[next] != no_id || material(next) != material(seed))
          continue;
        solid[next] = solid[seed];
        pending.push_back(next);
      }
    }
    materials.push_back(material(seed));
  }
  return {std::move(solid), std::move(materials)};
}

/// Points where an id of edges begins or ends, numbered as after `drop_unused_points`.
inline std::vector<local_id> ends_of_ids(const simplicial_mesh<2>& mesh, const std::vector<simplex<1>>& edges,
                                         const std::vector<local_id>& ids) {
  std::vector<std::pair<local_id, local_id>> at; // (point, id)
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const local_id v : edges[e])
      at.emplace_back(v, ids[e]);
  sort_all(at);
  std::vector<local_id> number(mesh.points.size(), no_id);
  for (const auto& triangle : mesh.elements)
    for (const local_id v : triangle)
      number[v] = 0;
  local_id next = 0;
  for (local_id& n : number)
    n = n == no_id ? no_id : next++;
  std::vector<local_id> corners;
  for (std::size_t first = 0, last = 0; first < at.size(); first = last) {
    while (last < at.size() && at[last].first == at[first].first)
      ++last;
    const local_id point = number[at[first].first];
    if (point != no_id && (last - first != 2 || at[first].second != at[last - 1].second))
      corners.push_back(point);
  }
  return corners;
}

} // namespace detail

DOVETAIL_INLINE mesh_boundary boundary_of(const simplicial_mesh<3>& mesh,
                                          const std::vector<simplex<2>>& given,
                                          const std::vector<local_id>& ids) {
  detail::require_boundary_to_find(mesh);
  detail::require_ids<2>(mesh.points, given, ids, "side");
  std::vector<std::pair<simplex<2>, local_id>> known;
  for (std::size_t s = 0; s < given.size(); ++s)
    known.emplace_back(sorted_vertices(given[s]), ids[s]);
  std::sort(known.begin(), known.end());

  const side_table<3> sides = build_sides(mesh);
  mesh_boundary made;
  auto& [surfaces, materials] = made;
  std::vector<local_id> solid_of;
  std::tie(solid_of, materials) = detail::solids_of(mesh, sides);
  surfaces.solids = static_cast<local_id>(materials.size());
  surfaces.mesh.points = mesh.points;
  std::size_t used = 0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    auto [behind, front] = sides.elements[s];
    const auto solid = [&](local_id e) { return e == no_id ? no_id : solid_of[e]; };
    if (front != no_id && solid(behind) == solid(front))
      continue;
    if (front != no_id && solid(front) < solid(behind))
      std::swap(behind, front);
    surfaces.mesh.elements.push_back(side_of_element<3>(mesh, sides, static_cast<local_id>(s), behind));
    surfaces.solid_of.push_back(solid(behind));
    surfaces.front_of.push_back(solid(front));
    const auto key = sorted_vertices(sides.vertices[s]);
    const auto at =
        std::lower_bound(known.begin(), known.end(), key,
                         [](const auto& side, const auto& wanted) { return side.first < wanted; });
    const bool is_known = at != known.end() && at->first == key;
    surfaces.groups.push_back(is_known ? at->second : no_id);
    used += is_known ? 1 : 0;
  }
  known.erase(std::unique(known.begin(), known.end(),
                          [](const auto& a, const auto& b) { return a.first == b.first; }),
              known.end());
  if (used < known.size())
    surfaces.repairs.warnings.push_back(std::to_string(known.size() - used) +
                                        " sides with ids are not on the boundary of a material; the adapted "
                                        "mesh knows nothing of them");
  drop_unused_points(surfaces.mesh);
  discrete::name_groups_by_numbers(surfaces);
  return made;
}

DOVETAIL_INLINE oriented_surfaces surface_of(const simplicial_mesh<2>& mesh,
                                             const std::vector<simplex<1>>& given,
                                             const std::vector<local_id>& ids) {
  detail::require_boundary_to_find(mesh);
  detail::require_ids<1>(mesh.points, given, ids, "edge");
  oriented_surfaces surfaces;
  surfaces.mesh.points = mesh.points;
  surfaces.mesh.elements = mesh.elements;
  surfaces.groups = mesh.tags;
  surfaces.groups.resize(mesh.elements.size(), no_id);
  surfaces.solid_of.assign(mesh.elements.size(), no_id);
  surfaces.corners = detail::ends_of_ids(mesh, given, ids);
  drop_unused_points(surfaces.mesh);
  discrete::name_groups_by_numbers(surfaces);
  return surfaces;
}

DOVETAIL_INLINE edge_ids::edge_ids(const std::vector<vec3>& points, const std::vector<simplex<1>>& edges,
                                   std::vector<local_id> ids)
    : ids_(std::move(ids)), met_(ids_.size(), false) {
  std::vector<box3> boxes;
  for (const auto& [a, b] : edges) {
    ends_.push_back({points[a], points[b]});
    box3& box = boxes.emplace_back();
    box.include(ends_.back()[0]), box.include(ends_.back()[1]);
  }
  tree_ = box_tree(boxes);
}

DOVETAIL_INLINE local_id edge_ids::at(vec3 p, double nearness) {
  double best = std::numeric_limits<double>::infinity();
  std::size_t found = 0;
  tree_.for_each_near(
      p, [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best; },
      [&](local_id edge) {
        const auto& [a, b] = ends_[edge];
        const double s = nearest_on_segment(a, b, p)[1];
        const double away = norm_squared(a + s * (b - a) - p);
        if (away < best || (away == best && static_cast<std::size_t>(edge) < found)) {
          best = away;
          found = static_cast<std::size_t>(edge);
        }
      });
  if (ids_.empty() || !(std::sqrt(best) <= nearness * distance(ends_[found][0], ends_[found][1])))
    return no_id;
  met_[found] = true;
  return ids_[found];
}

DOVETAIL_INLINE std::size_t edge_ids::missed() const {
  return static_cast<std::size_t>(std::count(met_.begin(), met_.end(), false));
}

} // namespace dovetail
