/// @file
/// All crossing pairs in a set of triangles, by an octree (paper, section 3.6) and the exact test of
/// `triangle_intersection.hpp`, cell by cell through an executor. Cells whose triangles lie beside each other
/// like those of a map (`single_sheet`) are left as they are: in a mesh of a smooth surface that is most of
/// it.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"
#include "dovetail/parallel/map_tasks.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// A pair of triangle indices, the smaller first.
using triangle_pair = std::pair<local_id, local_id>;

/// Parameters of the octree.
struct crossing_parameters {
  std::size_t leaf_size = 40; ///< no further subdivision at or below this many triangles (paper: 100)
  int depth_limit = 16;       ///< cells are not cut further beyond it
};

namespace detail {

/// The search in parts; what it was given must outlive it.
struct crossing_parts {
  std::size_t count = 0;                                              ///< how many there are
  std::function<std::vector<triangle_pair>(std::size_t)> search = {}; ///< of one of them, in any thread
};
crossing_parts parts_of_search(std::span<const vec3> points, std::span<const simplex<2>> triangles,
                               const std::function<bool(local_id, local_id)>& excluded,
                               const crossing_parameters& parameters, int workers);
/// Sorted, each once.
std::vector<triangle_pair> joined_pairs(const std::vector<std::vector<triangle_pair>>& found);

} // namespace detail

/// Crossing pairs among `triangles`, sorted, each once. A pair for which `excluded(i, j)` is true is not
/// tested. O(n log n) for triangles of bounded overlap; exact. Tasks go through `run`; the result does not
/// depend on its workers. Memory beside the triangles: some lists of 4 bytes per triangle. Throws
/// `time_limit_error` when a task is stopped by the clock, `mesher_error` when one fails otherwise.
/// \param points coordinates
/// \param triangles three indices of points each
/// \param excluded is called in workers, with indices of two triangles
/// \param run carries out independent tasks; the result does not depend on it
/// \param parameters when cells are no longer divided
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <executor Executor>
std::vector<triangle_pair>
crossing_triangles(std::span<const vec3> points, std::span<const simplex<2>> triangles,
                   const std::function<bool(local_id, local_id)>& excluded, const Executor& run,
                   const crossing_parameters& parameters = {}, const progress& on_progress = {}) {
  const auto parts = detail::parts_of_search(points, triangles, excluded, parameters, run.workers());
  auto found = map_tasks(run, parts.count, parts.search,
                         run_options{.on_progress = on_progress, .stage = "intersection"});
  return detail::joined_pairs(values_of(std::move(found), "the intersection test"));
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/intersection/crossing_triangles.ipp"
#endif
