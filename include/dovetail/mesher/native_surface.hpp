/// @file
/// The surface remesher as a mesher of D = 2.
#pragma once

#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/remesh/patch_remesher.hpp"

namespace dovetail::mesher {

/// About linear in the number of triangles made.
using native_surface = by_regions<remesh::patch_remesher>;
static_assert(boundary_keeping_mesher<native_surface, 2>);

} // namespace dovetail::mesher
