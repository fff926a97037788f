/// @file
/// The steps from a shape as it was read to a B-rep that can be meshed.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/models/occt/heal.hpp"
#include "dovetail/models/occt/imprint.hpp"
#include "dovetail/models/occt/touching_faces.hpp"

namespace dovetail::occt {

/// The `brep` of a shape, healed: repaired, with edges that lie on each other made one, and with what solids
/// have in common shared. Throws `geometry_error` naming the first entity that no repair mends.
/// \param input replaced by what the result is made of
/// \param made is told what was done
/// \param what solids alone, or faces beside them: of these such edges may be meant, as a crack
inline brep healed_brep(attributed_shape& input, report& made, wanted what = wanted::solids) {
  brep data = repaired_brep(input, made, what);
  if (what == wanted::solids)
    join_overlapping_edges(input, data, made);
  imprint_touching_bodies(input, data, made);
  return data;
}

} // namespace dovetail::occt
