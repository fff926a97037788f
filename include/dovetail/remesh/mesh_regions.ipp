/// @file
/// What `mesh_regions.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/hash.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/chain_sum.hpp"
#include "dovetail/remesh/chords.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/unwanted_chords.hpp"

#include <algorithm>

namespace dovetail {

namespace detail {

DOVETAIL_INLINE bool forbid_own_chords(const surface_region& region, const patch_mesh& made,
                                       patch_boundary& boundary) {
  if (!region.forbids)
    return false;
  auto& forbidden = boundary.forbidden_edges;
  const std::size_t before = forbidden.size();
  chord_finder(boundary).for_each(made.triangles, [&](std::size_t, const simplex<1>& chord) {
    if (region.forbids(chord[0], chord[1]) &&
        std::find(forbidden.begin(), forbidden.end(), chord) == forbidden.end())
      forbidden.push_back(chord);
  });
  return forbidden.size() > before;
}

DOVETAIL_INLINE void split_unwanted_chords(const any_surface& surface, const patch_boundary& boundary,
                                           patch_mesh& made) {
  unwanted_chord_splitter(surface, boundary, made).run();
}

DOVETAIL_INLINE void check_points_of(const patch_mesh& made, const any_surface& surface,
                                     const patch_boundary& boundary, const std::string& who) {
  const auto points = static_cast<local_id>(boundary.labels.size() + made.inner_uv.size());
  bool named = made.inner_points.size() == made.inner_uv.size();
  for (const simplex<2>& triangle : made.triangles)
    for (const local_id v : triangle)
      named = named && v >= 0 && v < points;
  if (!named)
    throw mesher_error(who + ": its triangles name points that do not exist");
  box3 box;
  for (const vec3 p : boundary.points)
    box.include(p);
  const double tolerance = 1e-6 * box.diagonal();
  for (std::size_t v = 0; v < made.inner_uv.size(); ++v)
    if (!(distance(surface.frame(made.inner_uv[v]).point, made.inner_points[v]) <= tolerance))
      throw mesher_error(who + ": its point " + std::to_string(v) +
                         " is not where its parameters are on the surface");
}

/// Whether triangles and segments close up: every side of a triangle is passed backwards by another triangle,
/// or is a segment. The sum of a hash of each, of opposite signs in opposite directions, is zero then.
inline bool closes_up(const patch_boundary& boundary, const patch_mesh& made) {
  const auto frozen = static_cast<local_id>(boundary.labels.size());
  const auto pass = [&](chain_sum& sum, local_id a, local_id b) {
    const auto name = [&](local_id v) { return v < frozen ? boundary.labels[v] : ~v; };
    if (name(a) != name(b)) // else along a pole
      sum.add(simplex<1>{name(a), name(b)});
  };
  chain_sum of_sides, of_segments;
  for (const simplex<2>& t : made.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      pass(of_sides, t[k], t[(k + 1) % 3]);
  for (const auto& [a, b] : boundary.segments)
    pass(of_segments, a, b);
  return of_sides == of_segments;
}

DOVETAIL_INLINE void check_region(const patch_mesh& made, const patch_boundary& boundary,
                                  const std::string& who) {
  if (!made.crossings.empty() || !made.misplaced.empty())
    return; // there is no mesh
  try {
    passages_of(boundary, made).check();
  } catch (const mesher_error& lost) {
    throw mesher_error(who + ": " + lost.what());
  }
  if (!closes_up(boundary, made))
    throw mesher_error(who + ": its triangles leave a hole or lie upon each other");
}

} // namespace detail

} // namespace dovetail
