/// @file
/// The coarse mesh that is decomposed: surface triangles on the CAD model and, in D = 3, tetrahedra between
/// them.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

namespace dovetail {

template <int D>
struct simplicial_background;

/// The mesh that is decomposed: in D = 2 the surface itself.
template <>
struct simplicial_background<2> {
  surface_mesh surface;

  const simplicial_mesh<2>& elements() const { return surface.mesh; }     ///< the mesh that is decomposed
  const std::vector<vec3>& points() const { return surface.mesh.points; } ///< its points

  using fields = field_list<&simplicial_background::surface>;
};

/// In D = 3 it is the volume: the first `surface.mesh.points.size()` points of `volume` are those of
/// `surface`, and every surface triangle is a side of the volume. `volume.tags` are materials: solids of the
/// model. A mesh that is not divided needs no volume.
template <>
struct simplicial_background<3> {
  surface_mesh surface;
  simplicial_mesh<3> volume;

  const simplicial_mesh<3>& elements() const { return volume; }
  const std::vector<vec3>& points() const {
    return volume.points.empty() ? surface.mesh.points : volume.points;
  }

  using fields = field_list<&simplicial_background::surface, &simplicial_background::volume>;
};

using background_mesh = simplicial_background<3>; ///< the coarse mesh of solids

} // namespace dovetail
