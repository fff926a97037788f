/// @file
/// Figures that `mesh` and `compare` take from a result in the same way: times of the stages, sizes of the
/// pieces.
#pragma once

#include "run_figures.hpp"

#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <span>
#include <string>

namespace dovetail::app {

/// Wall times from the report of `generate`, whose own is the total. Mesher and improver run in one task, one
/// after the other, and share the stage's time in proportion to what the workers spent on each.
inline stage_seconds seconds_of_stages(const report& summary) {
  stage_seconds seconds;
  seconds.background = summary.find("background").seconds;
  seconds.simplification = summary.find("simplification").seconds;
  seconds.partition = summary.find("partition").seconds;
  seconds.skeleton = summary.find("skeleton").seconds;
  seconds.intersection = summary.find("intersection").seconds;
  const report& meshing = summary.find("meshing");
  const double improver = meshing.get("improver_seconds");
  const double both = meshing.get("mesher_seconds") + improver;
  seconds.improvement = both > 0 ? meshing.seconds * improver / both : 0;
  seconds.meshing = meshing.seconds - seconds.improvement;
  seconds.total = summary.seconds;
  return seconds;
}

/// Elements of all pieces, and of the largest piece over the average.
struct piece_figures {
  std::int64_t elements = 0;
  double imbalance = 0;
};

inline piece_figures figures_of_pieces(std::span<const piece_counts> pieces) {
  piece_figures figures;
  std::int64_t largest = 0;
  for (const piece_counts& piece : pieces) {
    figures.elements += piece.elements;
    largest = std::max<std::int64_t>(largest, piece.elements);
  }
  if (figures.elements > 0)
    figures.imbalance = static_cast<double>(largest) * static_cast<double>(pieces.size()) /
                        static_cast<double>(figures.elements);
  return figures;
}

} // namespace dovetail::app
