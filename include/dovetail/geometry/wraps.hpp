/// @file
/// A geometry model around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/geometry/concepts.hpp"

#include <optional>

namespace dovetail {

/// Base of a geometry model that changes a part of what another one answers, or notes what it is asked. What
/// `Model` knows beyond a `geometry_model`, planes, members and its volume, is known of it too.
template <class Self, class Model>
struct model_wraps : wrapped_policy<Self, Model> {
  static_assert(geometry_model<Model>, "model_wraps holds a geometry_model (geometry/concepts.hpp)");
  using wrapped_policy<Self, Model>::wrapped_policy;
  using wrapped_policy<Self, Model>::wrapped;

  /// That of the wrapped model, as all that follows.
  decltype(auto) topology() const { return wrapped.topology(); }
  /// Point of a curve.
  vec3 curve_point(local_id c, double t) const { return wrapped.curve_point(c, t); }
  /// Point and derivative of a curve.
  dovetail::curve_frame curve_frame(local_id c, double t) const { return wrapped.curve_frame(c, t); }
  /// Parameters of a point of a face's coedge.
  vec2 curve_uv(local_id f, int k, double t) const { return wrapped.curve_uv(f, k, t); }
  /// Point of a face.
  vec3 face_point(local_id f, vec2 uv) const { return wrapped.face_point(f, uv); }
  /// Point and derivatives of a face.
  surface_frame face_frame(local_id f, vec2 uv) const { return wrapped.face_frame(f, uv); }
  /// Largest absolute principal curvature of a face.
  double face_curvature(local_id f, vec2 uv) const { return wrapped.face_curvature(f, uv); }
  /// Parameters of the nearest point of a face.
  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const { return wrapped.project_to_face(f, p, seed); }
  /// Parameter of the nearest point of a curve.
  double project_to_curve(local_id c, vec3 p, double seed) const {
    return wrapped.project_to_curve(c, p, seed);
  }
  /// Box of the model.
  box3 bounds() const { return wrapped.bounds(); }
  /// Whether queries may run in several threads at once.
  bool thread_safe() const { return wrapped.thread_safe(); }
  /// The plane of a face, where it is one.
  std::optional<surface_frame> plane_of_face(local_id f) const requires geometry_model_with_planes<Model> {
    return wrapped.plane_of_face(f);
  }
  /// The member of a face at a point, where it has members.
  local_id face_at(local_id f, vec3 p) const requires geometry_model_with_members<Model> {
    return wrapped.face_at(f, p);
  }
  /// The face that a member is a part of.
  local_id whole_face(local_id f) const requires geometry_model_with_members<Model> {
    return wrapped.whole_face(f);
  }
  /// Volume of all solids.
  double volume() const requires requires(const Model& model) { model.volume(); }
  { return wrapped.volume(); }
};

} // namespace dovetail
