/// @file
/// What a surface must be for its inside to be meshed with every triangle of it kept.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

namespace dovetail {

/// Throws `geometry_error`, which names the first places and says what to do, unless points are finite and
/// each at a place of its own, triangles have an area and are there once, every edge has two or more, and no
/// two triangles touch each other but in common edges and corners. Points of no triangle are not looked at.
/// O(n log n); most of it is the search for triangles that cross.
/// \param surface triangles
void require_fillable(const simplicial_mesh<2>& surface);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/fillable_surface.ipp"
#endif
