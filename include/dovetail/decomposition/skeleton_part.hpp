/// @file
/// A part of a coarse skeleton, to look at what a local change makes of it without the rest.
#pragma once

#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"

#include <vector>

namespace dovetail {

/// The regions and interface faces of a skeleton that have one of the given points, whole and as they are in
/// it, with all lines between their points. At these points it is as complete as the skeleton. Linear.
/// \param skeleton of the decomposed surface or volume
/// \param surface the coarse surface that the regions are of
/// \param is_wanted per point of the background mesh
coarse_skeleton part_at_points(coarse_skeleton skeleton, const surface_mesh& surface,
                               const std::vector<bool>& is_wanted);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/skeleton_part.ipp"
#endif
