/// @file
/// What `fillable_surface.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/pipeline/fillable_surface.hpp"
#include "dovetail/pipeline/surface_faults.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace dovetail {

namespace detail {

inline void require_points_of_surface(const simplicial_mesh<2>& surface) {
  if (surface.elements.empty())
    throw geometry_error("a surface without triangles encloses nothing");
  if (!surface.tags.empty() && surface.tags.size() != surface.elements.size())
    throw geometry_error(std::to_string(surface.tags.size()) + " tags for " +
                         std::to_string(surface.elements.size()) + " triangles; give one each, or none");
  std::vector<local_id> used;
  for (std::size_t t = 0; t < surface.elements.size(); ++t)
    for (const local_id v : surface.elements[t]) {
      if (v < 0 || static_cast<std::size_t>(v) >= surface.points.size())
        throw geometry_error("triangle " + std::to_string(t) + " refers to point " + std::to_string(v) +
                             ", which does not exist");
      used.push_back(v);
    }
  sort_unique(used);
  const auto at = [&](local_id v) { return surface.points[v]; };
  for (const local_id v : used)
    if (!is_finite(at(v)))
      throw geometry_error("point " + std::to_string(v) + " is at " + place_text(at(v)) +
                           "; give finite coordinates");
  const auto key = [&](local_id v) { return std::tuple(at(v).x, at(v).y, at(v).z, v); };
  sort_all(used, [&](local_id a, local_id b) { return key(a) < key(b); });
  surface_faults doubles;
  for (std::size_t i = 1; i < used.size(); ++i)
    if (at(used[i - 1]) == at(used[i]))
      doubles.add([&] {
        return std::to_string(used[i - 1]) + " and " + std::to_string(used[i]) + " at " +
               place_text(at(used[i]));
      });
  doubles.check("two points are at one place", "pairs of points are each at one place", "make them one");
}

inline void require_single_triangles(const simplicial_mesh<2>& surface) {
  surface_faults flat, repeated;
  for (std::size_t t = 0; t < surface.elements.size(); ++t) {
    const auto at = [&](std::size_t k) { return surface.points[surface.elements[t][k]]; };
    if (collinear(at(0), at(1), at(2)))
      flat.add([&] { return triangle_text(surface, t); });
  }
  flat.check("a triangle has no area", "triangles have no area", "remove them or move a point of theirs");
  for_each_group<3>(
      surface.elements.size(), surface.points.size(),
      [&](std::size_t t) { return sorted_vertices(surface.elements[t]); },
      [&](const simplex<2>&, std::span<const std::uint32_t> members) {
        if (members.size() > 1)
          repeated.add(
              [&] { return triangle_text(surface, members[0]) + " is also " + std::to_string(members[1]); });
      });
  repeated.check("a triangle is there more than once", "triangles are there more than once",
                 "leave one of each");
}

inline void require_closed_surface(const simplicial_mesh<2>& surface) {
  surface_faults open;
  for_each_group<2>(
      3 * surface.elements.size(), surface.points.size(),
      [&](std::size_t i) {
        const auto& t = surface.elements[i / 3];
        return sorted_vertices(simplex<1>{t[(i + 1) % 3], t[(i + 2) % 3]});
      },
      [&](const simplex<1>& edge, std::span<const std::uint32_t> members) {
        if (members.size() == 1)
          open.add([&] {
            return "from " + place_text(surface.points[edge[0]]) + " to " +
                   place_text(surface.points[edge[1]]);
          });
      });
  open.check("the surface is open: an edge has one triangle only",
             "edges have one triangle only: the surface is open", "close it");
}

inline void require_no_crossing(const simplicial_mesh<2>& surface) {
  surface_faults crossing;
  const auto none = [](local_id, local_id) { return false; };
  for (const triangle_pair& pair :
       crossing_triangles(span_of(surface.points), span_of(surface.elements), none, parallel::serial{}))
    crossing.add([&] {
      return triangle_text(surface, static_cast<std::size_t>(pair.first)) + " and " +
             triangle_text(surface, static_cast<std::size_t>(pair.second));
    });
  crossing.check("two triangles cross", "pairs of triangles cross",
                 "cut them along their intersection or move them apart");
}

} // namespace detail

DOVETAIL_INLINE void require_fillable(const simplicial_mesh<2>& surface) {
  detail::require_points_of_surface(surface);
  detail::require_single_triangles(surface);
  detail::require_closed_surface(surface);
  detail::require_no_crossing(surface);
}

} // namespace dovetail
