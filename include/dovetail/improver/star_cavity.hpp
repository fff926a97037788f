/// @file
/// A cavity that is filled from a single vertex: vertex insertion, and contraction of an edge, are both "take
/// these elements out, join their outline to one point".
#pragma once

#include "dovetail/improver/apex_search.hpp"
#include "dovetail/improver/size_band.hpp"

#include <algorithm>

namespace dovetail::improvement {

/// The elements to take out, and their outline: sides with the cavity on the inner side.
struct star_cavity {
  bounded_list<local_id, max_cavity> elements;
  bounded_list<std::array<local_id, 3>, max_star> outline;
  /// The half side that carries each side of the outline, inside the cavity.
  bounded_list<half_side, max_star> inner;

  void clear() { elements.size = outline.size = inner.size = 0; }
};

/// Marks exactly the elements of `cavity` and lists its outline. Sides at `apex` (an existing vertex on the
/// outline that the cavity is to be filled from, or `no_id`) are left out. False when there are too many.
inline bool find_outline(tet_complex& mesh, star_cavity& cavity, local_id apex) {
  mesh.clear_marks();
  for (const local_id e : cavity.elements)
    mesh.mark(e);
  cavity.outline.size = cavity.inner.size = 0;
  for (const local_id e : cavity.elements)
    for (int side = 0; side < 4; ++side) {
      if (!mesh.is_fixed(e, side) && mesh.is_marked(element_of(mesh.across(e, side))))
        continue;
      const auto& local = numbering::sides<3>[static_cast<std::size_t>(side)];
      const std::array<local_id, 3> v{mesh.vertex(e, local[0]), mesh.vertex(e, local[1]),
                                      mesh.vertex(e, local[2])};
      if (std::find(v.begin(), v.end(), apex) != v.end())
        continue;
      if (!cavity.outline.push(v) || !cavity.inner.push(half_side_of(e, side)))
        return false;
    }
  return true;
}

/// No fixed vertex would lose its last element, and the numbers of those that do may be given up.
inline bool keeps_fixed_vertices(const tet_complex& mesh, const star_cavity& cavity, local_id apex) {
  if (!mesh.can_release())
    return false;
  for (const local_id e : cavity.elements)
    for (const local_id v : mesh.vertices(e)) {
      if (mesh.is_free(v) || v == apex)
        continue;
      const bool is_on_outline =
          std::any_of(cavity.outline.begin(), cavity.outline.end(),
                      [v](const auto& side) { return side[0] == v || side[1] == v || side[2] == v; });
      if (!is_on_outline)
        return false;
    }
  return true;
}

/// Joins the outline to `apex`, whose place is set, if all values beat `bar` and the edges stay in the
/// band; releases the vertices that are
/// left without elements. False, and nothing changed, otherwise.
template <shape_measure Measure>
bool fill_from(tet_complex& mesh, const star_cavity& cavity, local_id apex, float bar, const size_band& band,
               local_change& change) {
  change.clear();
  for (const local_id e : cavity.elements)
    change.old.push(e);
  for (const auto& side : cavity.outline) {
    const auto value = static_cast<float>(
        measure_of<Measure>(mesh.point(apex), mesh.point(side[0]), mesh.point(side[1]), mesh.point(side[2])));
    if (!(value > bar) || !change.add({apex, side[0], side[1], side[2]}, value))
      return false;
  }
  if (change.fresh.size == 0 || !is_sound(mesh, change) || !band.admits(mesh, change))
    return false;
  bounded_list<local_id, 4 * max_cavity> inside;
  for (const local_id e : cavity.elements)
    for (const local_id v : mesh.vertices(e))
      inside.push(v);
  std::array<local_id, static_cast<std::size_t>(max_cavity)> ids;
  mesh.replace(change.old.view(), change.fresh.view(), change.values.view(),
               {ids.data(), static_cast<std::size_t>(change.fresh.size)});
  for (const local_id v : inside)
    if (mesh.is_free(v) && !mesh.is_used(v))
      mesh.release_vertex(v);
  return true;
}

} // namespace dovetail::improvement
