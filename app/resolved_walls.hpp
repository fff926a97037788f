/// @file
/// Automatic sizes in thin walls: small enough that elements in them are not flat, within a number of
/// elements, which are not divided where that is not asked for.
#pragma once

#include "model_source.hpp"
#include "pipeline.hpp"

namespace dovetail::app {

/// Makes the automatic sizes of a model smaller in its thin walls, as `automatic_points::walls_within` does
/// for 600,000 elements in all, or the number that is wanted; a warning of its summary says which walls are
/// given up. A mesh with thin walls is one piece up to two million elements, if it may be one at all:
/// interfaces across a wall have narrow triangles. Does nothing for other sizes, and where the model cannot
/// be planned as it was drawn. Throws what planning throws otherwise. One plan, if there are thin walls.
void resolve_walls(model_source& source, const model_options& wanted, const policies_of<3>& policies,
                   generate_options& options);
/// Triangles do not know walls.
inline void resolve_walls(model_source&, const model_options&, const policies_of<2>&, generate_options&) {}

} // namespace dovetail::app
