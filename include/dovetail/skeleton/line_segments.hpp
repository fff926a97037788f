/// @file
/// Numbers of segments that lines are given in place of those which the sizing field asks for.
#pragma once

#include "dovetail/parallel/memo.hpp"

#include <array>
#include <compare>
#include <vector>

namespace dovetail {

/// Other segments for a line; none leave it as it is.
struct line_segments {
  int count = 0;   ///< how many; 0 leaves the line as it is
  double bias = 0; ///< in (-1, 1): the first segments are longer by it, and the last shorter

  friend auto operator<=>(const line_segments&, const line_segments&) = default;
};
/// Of the lines of a face.
using face_segments = std::array<line_segments, 3>;
/// Those found for faces that were tried in turn.
using matched_faces = memo<std::vector<face_segments>>;

} // namespace dovetail
