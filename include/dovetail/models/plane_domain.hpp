/// @file
/// A plane domain with holes, islands and inner lines, as a geometry model: one face per connected part, in
/// the plane z = 0, whose parameters are x and y.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/plane/drawing.hpp"
#include "dovetail/models/plane/polyline.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace dovetail {

/// A geometry model made from a drawing. A polygon's points stay vertices of the model where the path turns
/// by more than `corner_deg`, where paths meet and at the ends of lines; between them it is one curve, which
/// the mesh follows at its own spacing.
class plane_domain {
public:
  /// Throws `geometry_error` as `check_drawing` does, and for a line that lies outside.
  explicit plane_domain(const plane_drawing& drawing, double corner_deg = 15);

  const geometry_topology& topology() const { return topology_; }
  vec3 curve_point(local_id c, double t) const;
  dovetail::curve_frame curve_frame(local_id c, double t) const;
  vec2 curve_uv(local_id f, int k, double t) const;
  vec3 face_point(local_id, vec2 uv) const { return in_space(uv); }
  surface_frame face_frame(local_id, vec2 uv) const { return {in_space(uv), {1, 0, 0}, {0, 1, 0}}; }
  double face_curvature(local_id, vec2) const { return 0; }
  vec2 project_to_face(local_id, vec3 p, vec2) const { return {p.x, p.y}; }
  double project_to_curve(local_id c, vec3 p, double seed) const;
  box3 bounds() const { return bounds_; }
  bool thread_safe() const { return true; }
  /// The plane with its axes, which meshers then evaluate themselves.
  std::optional<surface_frame> plane_of_face(local_id) const { return face_frame(0, {0, 0}); }

private:
  static constexpr vec3 in_space(vec2 p) { return {p.x, p.y, 0}; }
  const polyline& curve(local_id c) const { return curves_[c]; }

  std::vector<polyline> curves_;
  geometry_topology topology_;
  box3 bounds_;
};
static_assert(geometry_model<plane_domain>);

#ifdef DOVETAIL_COMPILED
extern template any_geometry::any_geometry(plane_domain);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/plane_domain.ipp"
#endif
