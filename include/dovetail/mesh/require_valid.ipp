/// @file
/// What `require_valid.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/mesh/validity.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace dovetail {

namespace detail {

DOVETAIL_INLINE void refuse_mesh(std::string_view who, const std::string& why) {
  throw mesh_error(std::string(who) + ": " + why);
}

DOVETAIL_INLINE void require_finite(std::span<const vec3> points, std::string_view who) {
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!is_finite(points[v]))
      refuse_mesh(who, "point " + std::to_string(v) + " is at " + place_text(points[v]) +
                           "; give finite coordinates");
}

template <int D>
void require_oriented(const simplicial_mesh<D>& mesh, std::size_t e, std::string_view who) {
  const auto at = [&](std::size_t k) { return mesh.points[mesh.elements[e][k]]; };
  const auto element = [&] {
    return "element " + std::to_string(e) + " (points " + listed_points(mesh.elements[e]) + ")";
  };
  if constexpr (D == 3) {
    const double sign = orient3d(at(0), at(1), at(2), at(3));
    if (sign < 0)
      refuse_mesh(who, element() + " is inverted: its volume is " +
                           number_text(signed_volume(at(0), at(1), at(2), at(3))) +
                           "; swap two of its points");
    if (sign == 0)
      refuse_mesh(who, element() + " is flat: its volume is 0; remove it or move a point of it");
  } else if (collinear(at(0), at(1), at(2))) {
    refuse_mesh(who, element() + " is flat: its area is 0; remove it or move a point of it");
  }
}

template <int D>
void require_elements(const simplicial_mesh<D>& mesh, std::string_view who, const mesh_demands& demands) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    refuse_mesh(who, std::to_string(mesh.tags.size()) + " tags for " + std::to_string(mesh.elements.size()) +
                         " elements; give one each or none");
  require_finite(mesh.points, who);
  const auto count = static_cast<local_id>(mesh.points.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& vertices = mesh.elements[e];
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      if (vertices[k] < 0 || vertices[k] >= count)
        refuse_mesh(who, "element " + std::to_string(e) + " refers to point " + std::to_string(vertices[k]) +
                             ", but the mesh has " + std::to_string(count) +
                             " points; they are numbered from 0");
      for (std::size_t j = 0; j < k; ++j)
        if (vertices[j] == vertices[k])
          refuse_mesh(who, "element " + std::to_string(e) + " uses point " + std::to_string(vertices[k]) +
                               " twice; remove it");
    }
    if (demands.orientation)
      require_oriented(mesh, e, who);
  }
}

/// A table that is not `build_sides(mesh)` would name elements that are not there.
template <int D>
void require_own_sides(const simplicial_mesh<D>& mesh, const side_table<D>& sides, std::string_view who) {
  const auto refuse = [&](const std::string& why) {
    refuse_mesh(who, "the sides are not those of the mesh: " + why + "; give build_sides(mesh)");
  };
  if (sides.of_element.size() != mesh.elements.size())
    refuse("they are of " + std::to_string(sides.of_element.size()) + " elements, the mesh has " +
           std::to_string(mesh.elements.size()));
  if (sides.vertices.size() != sides.elements.size())
    refuse(std::to_string(sides.vertices.size()) + " of " + std::to_string(sides.elements.size()) +
           " have vertices");
  const auto count = static_cast<local_id>(sides.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (std::size_t k = 0; k <= static_cast<std::size_t>(D); ++k) {
      const local_id side = sides.of_element[e][k];
      const auto own = pick(mesh.elements[e], numbering::sides<D>[k]);
      if (side < 0 || side >= count ||
          !std::is_permutation(own.begin(), own.end(), sides.vertices[side].begin()))
        refuse("element " + std::to_string(e) + " has no side with the points " + listed_points(own));
    }
}

/// Two elements that have two sides in common have all their points in common. In D = 2 that may be, of two
/// tags: two faces that meet along all of their boundary.
template <int D>
void require_different(const simplicial_mesh<D>& mesh, const side_table<D>& sides, std::string_view who) {
  const auto compare = [&](local_id e, local_id f) {
    const auto first = static_cast<std::size_t>(e), second = static_cast<std::size_t>(f);
    if (e == f || e == no_id || f == no_id ||
        (D == 2 && !mesh.tags.empty() && mesh.tags[first] != mesh.tags[second]) ||
        sorted_vertices(mesh.elements[first]) != sorted_vertices(mesh.elements[second]))
      return;
    refuse_mesh(who, "element " + std::to_string(std::max(e, f)) + " has the same points (" +
                         listed_points(mesh.elements[first]) + ") as element " +
                         std::to_string(std::min(e, f)) + "; remove one of them");
  };
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto element = static_cast<local_id>(e);
    const auto& of_element = sides.of_element[e];
    const auto& first = sides.elements[of_element[0]];
    const auto& second = sides.elements[of_element[1]];
    const local_id other = first[0] == element ? first[1] : first[0];
    if (other != no_id && (second[0] == other || second[1] == other))
      compare(element, other);
  }
  for (const auto& [side, element] : sides.further_elements) // usually none
    for (const local_id other : sides.all_elements(side))
      compare(element, other);
}

template <int D>
void require_sides(const simplicial_mesh<D>& mesh, const side_table<D>& sides, std::string_view who,
                   const mesh_demands& demands) {
  require_own_sides(mesh, sides, who);
  require_different(mesh, sides, who);
  if (D == 3 && !sides.further_elements.empty()) {
    const local_id side = sides.further_elements.front().first;
    std::string elements;
    for (const local_id e : sides.all_elements(side))
      elements += (elements.empty() ? "" : ", ") + std::to_string(e);
    refuse_mesh(who, "the elements " + elements + " all have the side (" +
                         listed_points(sides.vertices[side]) + "); no more than two may");
  }
  if (!demands.orientation)
    return;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto side = static_cast<local_id>(s);
    if (!sides.is_interior(side))
      continue;
    const auto [a, b] = sides.elements[s];
    if (D == 2 && !mesh.tags.empty() && mesh.tags[a] != mesh.tags[b])
      continue; // each face has an orientation of its own
    if (opposite(sides.vertices[s], side_of_element(mesh, sides, side, b)))
      continue;
    const std::string both = "the elements " + std::to_string(a) + " and " + std::to_string(b);
    const std::string their = " their common side (" + listed_points(sides.vertices[s]) + ")";
    refuse_mesh(who, D == 3 ? both + " overlap: they lie on the same side of" + their + "; remove one of them"
                            : both + " pass" + their +
                                  " in the same direction; swap two points of the one that is turned over");
  }
}

} // namespace detail

template <int D>
void require_valid(const simplicial_mesh<D>& mesh, const side_table<D>& sides, std::string_view who,
                   const mesh_demands& demands) {
  detail::require_elements(mesh, who, demands);
  detail::require_sides(mesh, sides, who, demands);
}

template <int D>
void require_valid(const simplicial_mesh<D>& mesh, std::string_view who, const mesh_demands& demands) {
  detail::require_elements(mesh, who, demands);
  detail::require_sides(mesh, build_sides(mesh), who, demands);
}

namespace detail {

DOVETAIL_INLINE void require_one_per_element(std::span<const local_id> numbers, std::size_t elements,
                                             local_id end, std::string_view who, std::string_view what) {
  if (numbers.size() != elements)
    throw usage_error(std::string(who) + ": " + std::to_string(numbers.size()) + " " + std::string(what) +
                      " for " + std::to_string(elements) + " elements; give one each");
  for (std::size_t e = 0; e < numbers.size(); ++e)
    if (numbers[e] < 0 || numbers[e] >= end)
      throw usage_error(
          std::string(who) + ": element " + std::to_string(e) + " has the number " +
          std::to_string(numbers[e]) + " among the " + std::string(what) + "; they are numbered from 0" +
          (end == std::numeric_limits<local_id>::max() ? "" : " to " + std::to_string(end - 1)));
}

#ifdef DOVETAIL_COMPILED
template void require_elements<2>(const simplicial_mesh<2>& mesh, std::string_view who,
                                  const mesh_demands& demands);
template void require_elements<3>(const simplicial_mesh<3>& mesh, std::string_view who,
                                  const mesh_demands& demands);
#endif

} // namespace detail

#ifdef DOVETAIL_COMPILED
template void require_valid<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides,
                               std::string_view who, const mesh_demands& demands);
template void require_valid<2>(const simplicial_mesh<2>& mesh, std::string_view who,
                               const mesh_demands& demands);
template void require_valid<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                               std::string_view who, const mesh_demands& demands);
template void require_valid<3>(const simplicial_mesh<3>& mesh, std::string_view who,
                               const mesh_demands& demands);
#endif

} // namespace dovetail
