/// @file
/// What `curved_model.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/models/curved/triangles.hpp"
#include "dovetail/models/curved_model.hpp"
#include "dovetail/models/discrete/cluster_measures.hpp"
#include "dovetail/models/discrete/smooth_areas.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace dovetail {

namespace detail {

/// The first of the shares 1, 1/2, ... of a step that leads nearer than `before`, with what is there.
template <class Frame, class Distance>
auto nearer_along(double before, const Frame& frame, const Distance& away_of) {
  std::optional<std::pair<double, decltype(frame(1.0))>> found;
  for (double share = 1; share > 0.05 && !found; share /= 2)
    if (auto at = frame(share); away_of(at) < before)
      found.emplace(share, std::move(at));
  return found;
}

} // namespace detail

struct curved_model::data {
  discrete_model flat;
  discrete::curved_triangles curved;
  geometry_topology topology;
  box3 bounds;
  double same = 0; ///< lengths below this are rounding
};

DOVETAIL_INLINE curved_model::curved_model(const oriented_surfaces& surfaces, const discrete_options& options)
    : curved_model(discrete_model(surfaces, options), surfaces, options) {}

DOVETAIL_INLINE const geometry_topology& curved_model::topology() const {
  return data_->topology;
}

DOVETAIL_INLINE box3 curved_model::bounds() const {
  return data_->bounds;
}

DOVETAIL_INLINE local_id curved_model::face_id(local_id f) const {
  return data_->flat.face_id(f);
}

DOVETAIL_INLINE const discrete_model& curved_model::flat() const {
  return data_->flat;
}

DOVETAIL_INLINE vec3 curved_model::curve_point(local_id c, double t) const {
  return carried(data_->flat.curve_point(c, t));
}

DOVETAIL_INLINE dovetail::curve_frame curved_model::curve_frame(local_id c, double t) const {
  const auto straight = data_->flat.curve_frame(c, t);
  const auto lift = data_->curved.at(straight.point, straight.derivative);
  return {straight.point + lift.to, straight.derivative + lift.change[0]};
}

DOVETAIL_INLINE vec2 curved_model::curve_uv(local_id f, int k, double t) const {
  return data_->flat.curve_uv(f, k, t);
}

DOVETAIL_INLINE vec3 curved_model::face_point(local_id f, vec2 uv) const {
  return carried(data_->flat.face_point(f, uv));
}

DOVETAIL_INLINE surface_frame curved_model::face_frame(local_id f, vec2 uv) const {
  const auto plane = data_->flat.face_frame(f, uv);
  const auto lift = data_->curved.at(plane.point, plane.du, plane.dv);
  return {plane.point + lift.to, plane.du + lift.change[0], plane.dv + lift.change[1]};
}

DOVETAIL_INLINE double curved_model::face_curvature(local_id f, vec2 uv) const {
  return data_->flat.face_curvature(f, uv);
}

DOVETAIL_INLINE vec2 curved_model::project_to_face(local_id f, vec3 p, vec2 seed) const {
  vec2 best = data_->flat.project_to_face(f, p, seed);
  auto at = face_frame(f, best);
  for (int step = 0; step < most_steps; ++step) {
    const vec3 away = p - at.point;
    const double uu = dot(at.du, at.du);
    const double uv = dot(at.du, at.dv);
    const double vv = dot(at.dv, at.dv);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 0))
      break;
    const double u = dot(at.du, away);
    const double v = dot(at.dv, away);
    const vec2 move{(vv * u - uv * v) / determinant, (uu * v - uv * u) / determinant};
    if (!(norm(move) > data_->same))
      break;
    const auto found = detail::nearer_along(
        norm(away), [&](double share) { return face_frame(f, best + share * move); },
        [&](const surface_frame& frame) { return distance(frame.point, p); });
    if (!found)
      break;
    best = best + found->first * move;
    at = found->second;
  }
  return best;
}

DOVETAIL_INLINE double curved_model::project_to_curve(local_id c, vec3 p, double seed) const {
  const auto& range = topology().curves[c].t;
  double best = data_->flat.project_to_curve(c, p, seed);
  auto at = curve_frame(c, best);
  for (int step = 0; step < most_steps; ++step) {
    const vec3 away = p - at.point;
    const double squared = norm_squared(at.derivative);
    if (!(squared > 0))
      break;
    const double move = std::clamp(best + dot(away, at.derivative) / squared, range[0], range[1]) - best;
    if (!(std::abs(move) > data_->same))
      break;
    const auto found = detail::nearer_along(
        norm(away), [&](double share) { return curve_frame(c, best + share * move); },
        [&](const dovetail::curve_frame& frame) { return distance(frame.point, p); });
    if (!found)
      break;
    best += found->first * move;
    at = found->second;
  }
  return best;
}

DOVETAIL_INLINE curved_model::curved_model(discrete_model flat, const oriented_surfaces& surfaces,
                                           const discrete_options& options) {
  const auto smooth_of = discrete::smooth_areas(discrete::cluster_measures(surfaces.mesh),
                                                element_neighbours(build_sides<2>(surfaces.mesh)),
                                                surfaces.groups, options.feature_angle_deg);
  auto made = std::make_shared<data>(
      data{flat, discrete::curved_triangles(discrete::triangle_curving(surfaces.mesh, smooth_of).run()),
           flat.topology(), flat.bounds()});
  const double height = made->curved.height();
  made->bounds.lower -= vec3{height, height, height};
  made->bounds.upper += vec3{height, height, height};
  made->same = 1e-13 * made->bounds.diagonal();
  data_ = made;
  for (auto& vertex : made->topology.vertices)
    vertex.point = carried(vertex.point);
}

DOVETAIL_INLINE vec3 curved_model::carried(vec3 p) const {
  return p + data_->curved.at(p).to;
}

} // namespace dovetail
