/// @file
/// Points on skeleton lines, spaced by the sizing field: on the CAD curve, projected to the CAD face, or
/// straight (paper, section 3.5). A line's points are a function of the line, the model and the field
/// alone.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/parallel/memo.hpp"
#include "dovetail/parallel/task_model.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/refined_sizing.hpp"
#include "dovetail/skeleton/fine_lines.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// Points of one line. `coarse_points` are the points of the background mesh.
/// About linear in the points made. Throws what the model and the field throw.
/// \param model the model that the line is of
/// \param line of the coarse skeleton
/// \param coarse_points those that the line refers to
/// \param size edge lengths wanted, in the units of the model
fine_line remesh_line(const any_geometry& model, const skeleton_line& line,
                      std::span<const vec3> coarse_points, const any_sizing& size);

/// The box in which a line looks for refined sizes.
box3 place_of(const skeleton_line& line, std::span<const vec3> coarse_points);

/// The points of a line, which are a function of it, its ends and what refines the sizes near it.
kept<fine_line> kept_line(const skeleton_line& line, std::span<const vec3> coarse_points,
                          const refined_sizing& size);

/// Points of all lines; those that are not in `made` are made through `run`.
/// Throws `mesher_error` naming what could not be evaluated.
/// About linear in the points made.
/// \param model the model that the lines are of
/// \param lines lines of the coarse skeleton
/// \param coarse_points points of the background mesh, that lines refer to
/// \param size edge lengths wanted, in the units of the model
/// \param run carries out independent tasks; the result does not depend on it
/// \param made lines of earlier rounds; grows
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
template <executor Executor>
remeshed_lines remesh_lines(const any_geometry& model, std::span<const skeleton_line> lines,
                            std::span<const vec3> coarse_points, const refined_sizing& size,
                            const Executor& run, memo<fine_line>& made, const progress& on_progress = {}) {
  constexpr double lines_per_task = 256;
  remeshed_lines result;
  std::vector<kept<fine_line>>& wanted = result.names;
  wanted.reserve(lines.size());
  for (const skeleton_line& line : lines)
    wanted.push_back(kept_line(line, coarse_points, size));
  const std::vector<double> costs(lines.size(), 1);
  const auto failures = made.make_missing(
      wanted, costs, lines_per_task,
      [&](const std::vector<std::size_t>& missing) {
        const task_model own(model, run);
        std::vector<fine_line> fine;
        for (const std::size_t l : missing)
          fine.push_back(
              remesh_line(own.get(), lines[l], coarse_points, size.near(place_of(lines[l], coarse_points))));
        return fine;
      },
      run, run_options{.on_progress = on_progress, .stage = "lines"});
  if (!failures.empty())
    throw mesher_error("remeshing of skeleton lines failed: " + failures.front().reason);
  result.lines.resize(lines.size());
  made.for_each(wanted, [&](std::size_t l, const fine_line& line) { result.lines[l] = line; });
  return result;
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/remesh_lines.ipp"
#endif
