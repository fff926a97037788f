/// @file
/// What a worker says of a piece: where it is, and what all need of it without loading it, in few bytes,
/// since every rank gets that of every piece.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/meshing/piece_work.hpp"
#include "dovetail/parallel/entity_store.hpp"

#include <algorithm>
#include <iterator>

namespace dovetail::detail {

struct piece_receipt {
  kept_value piece = {};
  piece_summary summary = {}; ///< its report is brief
  bool reused = false;        ///< the store had it

  using fields = field_list<&piece_receipt::piece, &piece_receipt::summary, &piece_receipt::reused>;
};

/// Of the report of a piece what is summed up over all pieces. The rest stays with the piece.
inline report brief(const report& piece) {
  report kept;
  kept.seconds = piece.seconds;
  kept.warnings = piece.warnings;
  kept.set("rung", piece.get("rung"));
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

} // namespace dovetail::detail
