/// @file
/// What `brief_summary.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/meshing/brief_summary.hpp"

#include <algorithm>
#include <iterator>

namespace dovetail::detail {

DOVETAIL_INLINE report brief(const report& piece) {
  report kept;
  kept.seconds = piece.seconds;
  kept.warnings = piece.warnings;
  auto counts = piece.as<attempt_counts>();
  if (const double stops = stops_by_clock(piece); stops > 0)
    counts.stops_by_clock = stops;
  kept.set(counts);
  for (const report& part : piece.children) {
    report& child = kept.children.emplace_back();
    child.name = part.name;
    child.seconds = part.seconds;
    child.warnings = part.warnings;
    std::copy_if(part.children.begin(), part.children.end(), std::back_inserter(child.children),
                 [](const report& of_part) { return of_part.name == "deviation"; });
  }
  return kept;
}

} // namespace dovetail::detail
