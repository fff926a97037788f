/// @file
/// What is said of a piece to all, in few bytes, since every rank gets that of every piece.
#pragma once

#include "dovetail/meshing/piece_work.hpp"

#include <utility>

namespace dovetail::detail {

/// Of the report of a piece what is summed up over all pieces. The rest stays with the piece.
report brief(const report& piece);
inline piece_summary brief_summary(piece_summary piece) {
  piece.summary = brief(piece.summary);
  return piece;
}

} // namespace dovetail::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/meshing/brief_summary.ipp"
#endif
