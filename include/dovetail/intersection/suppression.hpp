/// @file
/// What to do about crossing triangles of the fine skeleton (paper, section 3.6): a crossing with an
/// interface face merges the two subdomains at that face; a crossing of two CAD regions asks for a smaller
/// size there.
#pragma once

#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/remesh/patch.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

/// A crossing of two triangles, or of two edges of lines.
struct surface_crossing {
  std::array<local_id, 2> cad_faces; ///< no_id for an interface face
  vec3 center;                       ///< where it is
  double size;                       ///< mean edge length of the two triangles, or length of the edges
};

/// How the crossings found are to be removed.
struct suppression_plan {
  std::vector<std::array<local_id, 2>> merges = {}; ///< pairs of subdomains, smaller first, sorted, each once
  std::vector<surface_crossing> surface_crossings = {};   ///< of two CAD faces
  std::vector<surface_crossing> interface_crossings = {}; ///< what the merges are for
  std::string lines_at_fault = {}; ///< why, when the merges are for lines that cross in a parameter plane
  std::string folds = {};          ///< why, when regions are folded over; in `surface_crossings`
  bool merges_suffice = true;      ///< false where lines are at fault that no merge removes
  std::size_t crossings = 0;       ///< how many crossings were found

  bool empty() const { return merges.empty() && surface_crossings.empty() && lines_at_fault.empty(); }
};

namespace detail {

/// The crossing of triangles i and j.
surface_crossing describe_crossing(std::span<const vec3> points, std::span<const simplex<2>> triangles,
                                   std::span<const local_id> cad_faces, std::size_t i, std::size_t j);

} // namespace detail

/// Triangles of which no two cross, as an earlier search has found, and where the others are.
struct known_apart {
  std::vector<bool> triangles;     ///< per triangle; or empty
  std::vector<box3> around_others; ///< boxes that together hold all others
};

/// What is known of a skeleton some of whose patches, `apart`, growing, are of one without crossings.
/// Triangles of patch p begin at `first_triangle[p]` and end where the next one's begin. Nothing without any.
known_apart known_from_patches(const fine_skeleton& skeleton, std::span<const local_id> first_triangle,
                               std::span<const kept<patch_mesh>> patches,
                               std::span<const kept<patch_mesh>> apart);

namespace detail {

/// The triangles that are not known to be apart, and those near them; growing.
std::vector<local_id> triangles_to_search(const fine_skeleton& skeleton, const known_apart& known);
/// How crossing pairs are to be removed.
suppression_plan plan_for(const fine_skeleton& skeleton, const std::vector<triangle_pair>& pairs);

/// Crossing pairs of which not both are known to be apart, nor both planar.
template <executor Executor>
std::vector<triangle_pair> unknown_crossings(const fine_skeleton& skeleton, const std::vector<bool>& planar,
                                             const Executor& run, const known_apart& known,
                                             const crossing_parameters& parameters,
                                             const progress& on_progress) {
  const auto both = [](const std::vector<bool>& set, local_id i, local_id j) { return set[i] && set[j]; };
  if (known.triangles.empty())
    return crossing_triangles(
        skeleton.points, skeleton.sides, [&](local_id i, local_id j) { return both(planar, i, j); }, run,
        parameters, on_progress);
  const std::vector<local_id> near = triangles_to_search(skeleton, known);
  std::vector<simplex<2>> triangles;
  for (const local_id t : near)
    triangles.push_back(skeleton.sides[t]);
  const auto of_all = [&](local_id k) { return near[k]; };
  auto pairs = crossing_triangles(
      skeleton.points, triangles,
      [&](local_id i, local_id j) {
        return both(planar, of_all(i), of_all(j)) || both(known.triangles, of_all(i), of_all(j));
      },
      run, parameters, on_progress);
  for (auto& [i, j] : pairs)
    i = of_all(i), j = of_all(j);
  return pairs;
}

} // namespace detail

/// Finds the crossings of a fine skeleton. Two triangles of planar interface faces are not tested: those
/// faces are parts of the coarse mesh. `planar(t)` says whether triangle t belongs to one. Of two crossing
/// interface faces the one with the smaller pair of subdomains goes. Where most is known, only what is near
/// the rest is searched.
/// Complexity and errors are those of `crossing_triangles`: O(n log n); throws `time_limit_error` and
/// `mesher_error`.
/// \param skeleton the remeshed skeleton
/// \param planar one per triangle
/// \param run carries out independent tasks; the result does not depend on it
/// \param known what is known not to cross, from an earlier round
/// \param parameters when cells are no longer divided
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <executor Executor>
suppression_plan plan_suppression(const fine_skeleton& skeleton, const std::vector<bool>& planar,
                                  const Executor& run, const known_apart& known = {},
                                  const crossing_parameters& parameters = {},
                                  const progress& on_progress = {}) {
  return detail::plan_for(skeleton,
                          detail::unknown_crossings(skeleton, planar, run, known, parameters, on_progress));
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/intersection/suppression.ipp"
#endif
