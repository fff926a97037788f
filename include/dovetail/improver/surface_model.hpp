/// @file
/// Improves the surface mesh of a CAD model: vertices stay on their faces, curves stay as they are.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/improver/native_by.hpp"

#include <vector>

namespace dovetail::improvement {

/// CAD faces as a host; triangles' tags are faces of `model`, which must outlive the host.
template <geometry_model G>
surface_host host_on_model(const G& model) {
  const auto at = [&model](local_id face, vec2 uv) {
    const surface_frame f = model.face_frame(face, uv);
    const vec3 n = normalized(cross(f.du, f.dv));
    const bool is_reversed = model.topology().faces[static_cast<std::size_t>(face)].reversed;
    return host_point{f.point, is_reversed ? -n : n, uv};
  };
  return {[&model, at](local_id face, vec3 p, vec2 near) {
            return at(face, model.project_to_face(face, p, near));
          },
          at,
          {}};
}

/// Which points are poles of a face.
template <geometry_model G>
std::vector<bool> poles_of(const simplicial_mesh<2>& mesh, const G& model) {
  std::vector<bool> is_pole(mesh.points.size(), false);
  for (const auto& curve : model.topology().curves)
    if (curve.degenerate)
      is_pole[static_cast<std::size_t>(curve.vertices[0])] = true;
  return is_pole;
}

/// Improves a surface mesh in place by a native preset; points [0, vertices of the model) are its vertices.
/// Curve edges and the points on them keep their numbers and places.
template <geometry_model G>
report improve_on_model(const native& preset, surface_mesh& surface, const G& model,
                        const any_sizing& size = {}) {
  surface_host faces = host_on_model(model);
  faces.corner_uv = surface.corner_uv;
  frozen_entities<2> frozen{0, sides_at_poles(surface.mesh, poles_of(surface.mesh, model))};
  for (const auto& edge : surface.curve_edges)
    frozen.sides.push_back(edge.vertices);
  report result =
      improve_surface<native_operations>(preset, surface.mesh, frozen, size, faces, &surface.corner_uv);
  // Points inside faces may have new numbers.
  const std::size_t known = surface.vertex_hosts.size();
  surface.vertex_hosts.resize(surface.mesh.points.size());
  for (std::size_t t = 0; t < surface.mesh.elements.size(); ++t)
    for (const local_id v : surface.mesh.elements[t])
      if (host& lies_on = surface.vertex_hosts[static_cast<std::size_t>(v)];
          static_cast<std::size_t>(v) >= known || lies_on.dimension == 2)
        lies_on = {2, surface.mesh.tags[t]};
  return result;
}

} // namespace dovetail::improvement
