/// @file
/// Figures that `mesh` and `compare` take from a result in the same way: times of the stages, sizes of the
/// pieces.
#pragma once

#include "run_figures.hpp"

#include "dovetail/core/failure_reasons.hpp"
#include "dovetail/experiments/baselines/labelled_elements.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

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
  seconds.bisection = summary.find("recursive bisection").seconds;
  const report& meshing = summary.find("meshing");
  const auto counts = meshing.as<meshing_counts>();
  const double improver = counts.improver_seconds;
  const double both = counts.mesher_seconds + improver;
  seconds.improvement = both > 0 ? meshing.seconds * improver / both : 0;
  seconds.meshing = meshing.seconds - seconds.improvement;
  seconds.fine_partition = summary.find("fine partition").seconds;
  seconds.improvement += summary.find("improvement").seconds;
  seconds.total = summary.seconds;
  return seconds;
}

/// What is known of improving again, from the report of an `improving_strategy`.
inline void add_passes(const report& improvement, run_figures& figures) {
  const bool once = improvement.find("first pass").name.empty();
  figures.seconds.first_pass = once ? improvement.seconds : improvement.find("first pass").seconds;
  for (const char* between : {"collection", "redistribution"}) {
    const report& part = improvement.find(between);
    figures.seconds.between_passes += part.seconds;
    const auto moved = part.as<baselines::moved_counts>();
    figures.elements_between_passes += moved.elements;
    figures.largest_over_mean += moved.largest_over_mean;
  }
  figures.seconds.second_pass = improvement.find("second pass").seconds;
  figures.seconds.writing_back = improvement.find("writing back").seconds;
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

/// Appends the warnings of a report and of all its parts.
inline void collect_warnings(const report& from, std::vector<std::string>& to) {
  to.insert(to.end(), from.warnings.begin(), from.warnings.end());
  for (const auto& part : from.children)
    collect_warnings(part, to);
}

/// What to say of subdomains that no attempt could mesh.
inline std::string text_of_failures(const std::vector<piece_failure>& failures) {
  std::string text = std::to_string(failures.size()) + " subdomains could not be meshed:";
  bool had_room = true;
  for (const auto& failure : failures) {
    for (const std::string& reason : failure.reasons)
      had_room = had_room && !detail::is_for_want_of_room(reason);
    text += " subdomain " + std::to_string(failure.subdomain) + ": " + joined_reasons(failure.reasons);
    if (!failure.facets.empty())
      text += " (facets in " + failure.facets.string() + ")";
    text += ";";
  }
  return text + (had_room ? " give another size or --subdomains"
                          : " allow more memory or stack, or give fewer --workers or more --subdomains");
}

} // namespace dovetail::app
