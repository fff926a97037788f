/// @file
/// From the mesh of a mesher that keeps lines but no triangles to a background mesh: its boundary triangles
/// take the role of the coarse surface mesh, with the CAD entity of each point and the parameters of each
/// corner.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/background_mesh.hpp"

#include <vector>

namespace dovetail::background {

/// The lines of a surface mesh that lie on CAD curves: for each curve that is not a pole, its points in
/// order.
std::vector<std::vector<vec3>> lines_on_curves(const surface_mesh& surface);

/// The background mesh of a model with one solid from a mesh of its inside whose edges follow
/// `lines_on_curves(reference)`. Boundary points move to the CAD surface. About n log n in the triangles,
/// and boundary points times vertices of the model. Throws `mesher_error` when a curve was not kept as a line
/// or an element gets inverted, and what the geometry throws.
background_mesh background_of_whole_domain(const any_geometry& model, const surface_mesh& reference,
                                           const simplicial_mesh<3>& volume);

} // namespace dovetail::background

#ifndef DOVETAIL_COMPILED
#include "dovetail/background/whole_domain.ipp"
#endif
