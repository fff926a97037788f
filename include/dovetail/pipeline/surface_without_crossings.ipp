/// @file
/// What `surface_without_crossings.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/intersection/offending_facets.hpp"
#include "dovetail/pipeline/surface_without_crossings.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <set>
#include <vector>

namespace dovetail {

namespace detail {

/// The place of a coarse triangle, for sizes of so many times its longest edge.
inline size_ball place_of_triangle(const simplicial_mesh<2>& mesh, std::size_t t, double times) {
  const auto& triangle = mesh.elements[t];
  vec3 center{};
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const vec3 a = mesh.points[triangle[k]];
    const vec3 b = mesh.points[triangle[(k + 1) % 3]];
    center += a / 3.0;
    longest = std::max(longest, distance(a, b));
  }
  return {center, longest, times * longest};
}

/// Where coarse triangles cross, as places to refine: a ball around both at less than half their size. Thin
/// tubes and sheets cross elsewhere when that is done; of these, in late rounds, the whole faces, as long as
/// the mesh is small.
inline std::vector<size_ball> places_to_refine(const simplicial_mesh<2>& mesh,
                                               const std::vector<triangle_pair>& crossing, bool late) {
  constexpr std::size_t small = 20000; // triangles; it grows threefold

  std::vector<size_ball> places;
  std::set<local_id> faces;
  for (const triangle_pair& pair : crossing)
    for (const local_id t : {pair.first, pair.second}) {
      faces.insert(mesh.tags[t]);
      places.push_back(place_of_triangle(mesh, static_cast<std::size_t>(t), 0.4));
    }
  for (std::size_t t = 0; late && mesh.elements.size() <= small && t < mesh.elements.size(); ++t)
    if (faces.contains(mesh.tags[t]))
      places.push_back(place_of_triangle(mesh, t, 0.7));
  return places;
}

DOVETAIL_INLINE background::coarse_surface_result surface_without_crossings_by(
    const any_geometry& model,
    const std::function<background::coarse_surface_result(const background::coarse_surface_parameters&)>&
        make,
    const any_executor& run, int refinement_rounds, const progress& on_progress) {
  background::coarse_surface_parameters parameters;
  parameters.on_progress = on_progress.only_stopping();
  // Sheets that lie upon each other, or pass through each other, cross at more and more triangles.
  double most_pairs = 0, most_late = 0;
  constexpr int rounds_at_crossings = 2;
  int round = 0;
  parameters.finer_at = [&](const background::coarse_surface_result& made) {
    const simplicial_mesh<2>& mesh = made.surface.mesh;
    const auto pairs = crossing_triangles(mesh.points, mesh.elements, {}, run, {}, parameters.on_progress);
    const auto count = static_cast<double>(pairs.size());
    if (round == 0) {
      most_pairs = 10.0 * static_cast<double>(mesh.elements.size()) + 1000;
      most_late = 2 * count + 1000;
    }
    if (count > 0 && (round >= refinement_rounds || count > most_pairs || (round > 2 && count > most_late)))
      throw_crossing_faces(model.topology(),
                           {mesh.tags[pairs.front().first], mesh.tags[pairs.front().second]});
    return places_to_refine(mesh, pairs, ++round > rounds_at_crossings);
  };
  return make(parameters);
}

} // namespace detail

} // namespace dovetail
