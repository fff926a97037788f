/// @file
/// The coarse mesh that is decomposed: surface triangles on the CAD model and tetrahedra between them.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

namespace dovetail {

/// The first `surface.mesh.points.size()` points of `volume` are those of `surface`, and every surface
/// triangle is a side of the volume. `volume.tags` are materials: solids of the model.
struct background_mesh {
  surface_mesh surface;
  simplicial_mesh<3> volume;
};

} // namespace dovetail
