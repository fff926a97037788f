/// @file
/// What is said of a piece to all, in few bytes, since every rank gets that of every piece.
#pragma once

#include "dovetail/meshing/piece_work.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace dovetail::detail {

/// Of the report of a piece what is summed up over all pieces. The rest stays with the piece.
inline report brief(const report& piece) {
  report kept;
  kept.seconds = piece.seconds;
  kept.warnings = piece.warnings;
  kept.set("attempt", piece.get("attempt"));
  if (const double stops = stops_by_clock(piece); stops > 0)
    kept.set("stops_by_clock", stops);
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
inline piece_summary brief_summary(piece_summary piece) {
  piece.summary = brief(piece.summary);
  return piece;
}

} // namespace dovetail::detail
