/// @file
/// The own shape of a side, by which the worse of two sides is told.
#pragma once

#include "dovetail/mesh/side_table.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <vector>

namespace dovetail {

/// D = 3: the smallest corner angle of each side, in degrees.
std::vector<double> side_shapes(const simplicial_mesh<3>& mesh, const side_table<3>& sides);

/// D = 2: an edge has no angle of its own; it is judged by the smallest corner angle that it bounds.
std::vector<double> side_shapes(const simplicial_mesh<2>& mesh, const side_table<2>& sides);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/simplification/side_shape.ipp"
#endif
