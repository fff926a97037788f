/// @file
/// Points inside the voids of an oriented boundary, for meshers that take hole points.
///
/// They only save work: a mesher that meshed a void anyway has it removed afterwards by `label_elements`, and
/// the checks after meshing find a wrong one.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <vector>

namespace dovetail {

/// One point for each void: a shell that faces inwards. From the middle of its largest triangle, half way to
/// the next triangle along the outward normal. Shells that touch others along an edge are left out.
std::vector<vec3> points_in_voids(const simplicial_mesh<2>& boundary);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/adapters/void_points.ipp"
#endif
