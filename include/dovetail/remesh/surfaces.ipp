/// @file
/// What `surfaces.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/remesh/surfaces.hpp"

#include <memory>

namespace dovetail {

DOVETAIL_INLINE any_surface surface_of_face(const any_geometry& model, local_id face) {
  return {[&model, face](vec2 uv) { return model.face_frame(face, uv); },
          [&model, face](vec3 p, vec2 seed) { return model.project_to_face(face, p, seed); }};
}

DOVETAIL_INLINE any_surface surface_of_face(const std::shared_ptr<const any_geometry>& model, local_id face) {
  any_surface surface{[model, face](vec2 uv) { return model->face_frame(face, uv); },
                      [model, face](vec3 p, vec2 seed) { return model->project_to_face(face, p, seed); }};
  if (const auto plane = model->plane_of_face(face))
    surface.plane = remesh::plane_surface{plane->point, plane->du, plane->dv};
  return surface;
}

} // namespace dovetail
