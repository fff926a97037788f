/// @file
/// Surfaces for the patch remesher: a plane, a face of a geometry model, a curved interface face.
#pragma once

#include "dovetail/remesh/patch.hpp"

namespace dovetail::remesh {

/// A plane with orthonormal axes; parameters are coordinates along them.
struct plane_surface {
  vec3 origin;
  vec3 x_axis{1, 0, 0};
  vec3 y_axis{0, 1, 0};

  /// The plane of a triangle, seen so that (a, b, c) is counter-clockwise; a is the origin.
  static plane_surface of_triangle(vec3 a, vec3 b, vec3 c) {
    const vec3 x = normalized(b - a);
    const vec3 n = normalized(cross(b - a, c - a));
    return {a, x, cross(n, x)};
  }

  surface_frame frame(vec2 uv) const { return {origin + uv.x * x_axis + uv.y * y_axis, x_axis, y_axis}; }
  vec2 project(vec3 p, vec2 = {}) const { return {dot(p - origin, x_axis), dot(p - origin, y_axis)}; }
};

/// A face of a geometry model, which must outlive this.
template <geometry_model G>
struct model_surface {
  const G* model;
  local_id face;

  surface_frame frame(vec2 uv) const { return model->face_frame(face, uv); }
  vec2 project(vec3 p, vec2 seed) const { return model->project_to_face(face, p, seed); }
};

} // namespace dovetail::remesh
