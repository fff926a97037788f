/// @file
/// Meshes as bytes: what every worker needs of them can be sent, and kept for a resumed run.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/mesh/background_mesh.hpp"

namespace dovetail {

template <int D>
void encode(byte_writer& to, const simplicial_mesh<D>& mesh) {
  to.array(mesh.points);
  to.array(mesh.elements);
  to.array(mesh.tags);
}

template <int D>
simplicial_mesh<D> decode_mesh(byte_reader& from) {
  simplicial_mesh<D> mesh;
  mesh.points = from.array<vec3>();
  mesh.elements = from.array<simplex<D>>();
  mesh.tags = from.array<local_id>();
  return mesh;
}

inline void encode(byte_writer& to, const surface_mesh& surface) {
  encode(to, surface.mesh);
  to.array(surface.corner_uv);
  to.array(surface.vertex_hosts);
  to.array(surface.curve_edges);
}

inline surface_mesh decode_surface(byte_reader& from) {
  surface_mesh surface;
  surface.mesh = decode_mesh<2>(from);
  surface.corner_uv = from.array<std::array<vec2, 3>>();
  surface.vertex_hosts = from.array<host>();
  surface.curve_edges = from.array<surface_mesh::curve_edge>();
  return surface;
}

template <int D>
void encode(byte_writer& to, const simplicial_background<D>& background) {
  encode(to, background.surface);
  if constexpr (D == 3)
    encode(to, background.volume);
}

template <int D>
simplicial_background<D> decode_background(byte_reader& from) {
  simplicial_background<D> background;
  background.surface = decode_surface(from);
  if constexpr (D == 3)
    background.volume = decode_mesh<3>(from);
  return background;
}

} // namespace dovetail
