/// @file
/// OCCT's own triangulation of a model, as a start for remeshing, for planning and for pictures.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/models/occt_model.hpp"

#include <vector>

namespace dovetail {

/// How fine OCCT's triangles are.
struct triangulation_parameters {
  double deflection = 0; ///< largest distance to the surface, model units; 0 for a thousandth of the diagonal
  double angle = 0.35;   ///< largest turn of the normal along an edge, radians
};

/// OCCT's triangulation with common vertices merged: conforming along curves, closed around each solid,
/// coarse and of any triangle shape. Points on curves lie on the 3D curve. O(triangles). Throws
/// `geometry_error` naming the face that cannot be triangulated.
surface_mesh occt_triangulation(const occt_model& model, triangulation_parameters parameters = {});

/// Area of every face, by OCCT's quadrature.
std::vector<double> occt_face_areas(const occt_model& model);

/// Volume of every solid, by OCCT's quadrature.
std::vector<double> occt_solid_volumes(const occt_model& model);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED_OCCT
#include "dovetail/models/occt/triangulation.ipp"
#endif
