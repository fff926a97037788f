/// @file
/// The sizes that a surface of triangles has of itself, growing away from it.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/point_sizes.hpp"

namespace dovetail {

/// h(x) = min over the surface's points p of (mean length of the edges at p) + growth |x - p|: sizes for the
/// inside of a surface that is kept. O(n log n), then about log n steps per evaluation. Throws `sizing_error`
/// for a growth that is not positive and finite, or a surface without extent.
/// \param surface triangles
/// \param growth how much sizes grow per length, > 0
point_sizes surface_sizes(const simplicial_mesh<2>& surface, double growth);

/// A field made smaller near those points of a surface whose edges are much shorter than it says, so that it
/// grows from these by no more than `growth` per length: triangles that are kept can be met by no larger
/// elements. The field itself where there are none. Cost and errors as above, and of the field.
any_sizing within_surface_sizes(any_sizing size, const simplicial_mesh<2>& surface, double growth);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/surface_sizes.ipp"
#endif
