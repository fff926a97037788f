/// @file
/// A cavity that is filled from a single vertex: vertex insertion, and contraction of an edge, are both "take
/// these elements out, join their outline to one point".
#pragma once

#include "dovetail/improver/tetrahedra/apex_search.hpp"
#include "dovetail/improver/tetrahedra/size_band.hpp"

#include <algorithm>
#include <array>

namespace dovetail::improvement {

/// The elements to take out, and their outline: sides with the cavity on the inner side.
struct star_cavity {
  bounded_list<local_id, max_cavity> elements;             ///< elements to take out
  bounded_list<std::array<local_id, 3>, max_star> outline; ///< the sides around them
  /// The half side that carries each side of the outline, inside the cavity.
  bounded_list<half_side, max_star> inner;

  void clear() { elements.size = outline.size = inner.size = 0; }
};

/// Marks exactly the elements of `cavity` and lists its outline. Sides at `apex` (an existing vertex on the
/// outline that the cavity is to be filled from, or `no_id`) are left out. False when there are too many.
bool find_outline(tet_complex& mesh, star_cavity& cavity, local_id apex);

/// The vertices of the cavity that are not on its outline: they would be removed. `apex` stays anyway.
void find_inside(const tet_complex& mesh, const star_cavity& cavity, local_id apex,
                 bounded_list<local_id, 4 * max_cavity>& inside);

/// No fixed vertex would lose its last element, and the numbers of the free ones that do can be given up,
/// when `added` vertices are added at the same time.
inline bool may_lose_inside(const tet_complex& mesh, const star_cavity& cavity, local_id apex, int added) {
  bounded_list<local_id, 4 * max_cavity> inside;
  find_inside(mesh, cavity, apex, inside);
  return inside.size <= mesh.releasable() + added &&
         std::all_of(inside.begin(), inside.end(), [&mesh](local_id v) { return mesh.is_free(v); });
}

/// Fewer of the fresh elements are bad than of the old ones or, if as many, they together lack less. Without
/// this a cavity between fixed surfaces that lie too close is filled with ever more elements, each a little
/// better than the worst one before.
/// \param bad the quality below which an element is bad
bool pays(const tet_complex& mesh, const local_change& change, float bad);

/// Joins the outline to `apex`, whose place is set, if all values beat `bar`, the elements together lack less
/// and the edges stay in the band; releases the vertices that are left without elements. False, and nothing
/// changed, otherwise.
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
  if (change.fresh.size == 0 || !pays(mesh, change, static_cast<float>(Measure::from_angle(12))) ||
      !is_sound(mesh, change) || !band.admits(mesh, change))
    return false;
  bounded_list<local_id, 4 * max_cavity> inside;
  find_inside(mesh, cavity, apex, inside);
  std::array<local_id, static_cast<std::size_t>(max_cavity)> ids;
  mesh.replace(change.old.view(), change.fresh.view(), change.values.view(),
               {ids.data(), static_cast<std::size_t>(change.fresh.size)});
  for (const local_id v : inside)
    mesh.release_vertex(v);
  return true;
}

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/tetrahedra/star_cavity.ipp"
#endif
