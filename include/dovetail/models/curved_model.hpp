/// @file
/// A triangulated surface as a geometry model that is as smooth as what it was made of.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/discrete/oriented_surfaces.hpp"
#include "dovetail/models/discrete_model.hpp"

#include <memory>

namespace dovetail {

/// A model of `geometry_model` that goes through the points of a triangulated surface, and between them on
/// arcs that its normals and feature curves tell, instead of on plane triangles: for the boundary of a mesh
/// that is meshed again, and again, and would lose volume each time otherwise. Faces, curves and parameters
/// are those of a `discrete_model`, whose points are displaced; planes stay planes. Copies are cheap. Queries
/// are thread-safe, O(log n).
class curved_model {
public:
  /// Throws `geometry_error` when charts cannot be made.
  explicit curved_model(const oriented_surfaces& surfaces, const discrete_options& options = {});

  const geometry_topology& topology() const;
  box3 bounds() const;
  bool thread_safe() const { return true; }
  /// The number that came with the triangles of face f, or no_id.
  local_id face_id(local_id f) const;

  /// The model whose points are displaced.
  const discrete_model& flat() const;

  vec3 curve_point(local_id c, double t) const;
  dovetail::curve_frame curve_frame(local_id c, double t) const;
  vec2 curve_uv(local_id f, int k, double t) const;

  vec3 face_point(local_id f, vec2 uv) const;
  surface_frame face_frame(local_id f, vec2 uv) const;
  double face_curvature(local_id f, vec2 uv) const;

  /// Newton's method from the nearest point of the triangles; a step that does not lead nearer is halved.
  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const;
  double project_to_curve(local_id c, vec3 p, double seed) const;

private:
  static constexpr int most_steps = 30;

  struct data;

  curved_model(discrete_model flat, const oriented_surfaces& surfaces, const discrete_options& options);

  vec3 carried(vec3 p) const;

  std::shared_ptr<const data> data_;
};

static_assert(geometry_model<curved_model>);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/curved_model.ipp"
#endif
