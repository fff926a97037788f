/// @file
/// Surfaces that are meshed: a plane, and any surface, among them a face of a geometry model.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/remesh/patch.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace dovetail::remesh {

/// A plane with orthonormal axes; parameters are coordinates along them.
struct plane_surface {
  vec3 origin;          ///< where both parameters are 0
  vec3 x_axis{1, 0, 0}; ///< along the first parameter
  vec3 y_axis{0, 1, 0}; ///< along the second parameter

  /// The plane of a triangle, seen so that (a, b, c) is counter-clockwise; a is the origin.
  static plane_surface of_triangle(vec3 a, vec3 b, vec3 c) {
    const vec3 x = normalized(b - a);
    const vec3 n = normalized(cross(b - a, c - a));
    return {a, x, cross(n, x)};
  }

  surface_frame frame(vec2 uv) const { return {origin + uv.x * x_axis + uv.y * y_axis, x_axis, y_axis}; }
  vec2 project(vec3 p, vec2 = {}) const { return {dot(p - origin, x_axis), dot(p - origin, y_axis)}; }
};

} // namespace dovetail::remesh

namespace dovetail {

/// A parametric surface chosen at run time; a model of `patch_surface`.
struct any_surface {
  std::function<surface_frame(vec2)> frame;
  std::function<vec2(vec3, vec2)> project;
  /// The same surface where it is a plane with orthonormal parameters, for meshers that then need no calls.
  std::optional<remesh::plane_surface> plane = std::nullopt;

  /// Another surface, which must outlive this.
  template <patch_surface S>
  static any_surface view_of(const S& surface) {
    any_surface seen{[&surface](vec2 uv) { return surface.frame(uv); },
                     [&surface](vec3 p, vec2 seed) { return surface.project(p, seed); }};
    if constexpr (std::same_as<S, remesh::plane_surface>)
      seen.plane = surface;
    return seen;
  }
  /// Another surface, which it keeps.
  template <patch_surface S>
  static any_surface holding(S surface) {
    const auto held = std::make_shared<const S>(std::move(surface));
    return {[held](vec2 uv) { return held->frame(uv); },
            [held](vec3 p, vec2 seed) { return held->project(p, seed); }};
  }
};

/// A face of a model in the model's own parameters; the model must outlive it.
template <geometry_model Geometry>
any_surface surface_of_face(const Geometry& model, local_id face) {
  return {[&model, face](vec2 uv) { return model.face_frame(face, uv); },
          [&model, face](vec3 p, vec2 seed) { return model.project_to_face(face, p, seed); }};
}

/// A face of a model, which it keeps alive; in orthonormal parameters where it is a plane.
template <geometry_model Geometry>
any_surface surface_of_face(const std::shared_ptr<const Geometry>& model, local_id face) {
  any_surface surface{[model, face](vec2 uv) { return model->face_frame(face, uv); },
                      [model, face](vec3 p, vec2 seed) { return model->project_to_face(face, p, seed); }};
  if (const auto plane = plane_of_face(*model, face))
    surface.plane = remesh::plane_surface{plane->point, plane->du, plane->dv};
  return surface;
}

} // namespace dovetail
