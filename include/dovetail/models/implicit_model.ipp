/// @file
/// What `implicit_model.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/implicit/function.hpp"
#include "dovetail/models/implicit/triangulation.hpp"
#include "dovetail/models/implicit_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace dovetail {

struct implicit_model::data {
  level_set function;
  discrete_model start;
  geometry_topology topology;
  box3 bounds;
  double reach = 0; ///< how far the start triangulation may be from the surface
};

DOVETAIL_INLINE const geometry_topology& implicit_model::topology() const {
  return data_->topology;
}

DOVETAIL_INLINE box3 implicit_model::bounds() const {
  return data_->bounds;
}

DOVETAIL_INLINE const charted_surface& implicit_model::surface() const {
  return data_->start.surface();
}

DOVETAIL_INLINE vec3 implicit_model::curve_point(local_id c, double t) const {
  return carried(data_->start.curve_point(c, t));
}

DOVETAIL_INLINE dovetail::curve_frame implicit_model::curve_frame(local_id c, double t) const {
  const auto straight = data_->start.curve_frame(c, t);
  const vec3 p = carried(straight.point);
  const vec3 n = normalized(data_->function.gradient(p));
  return {p, straight.derivative - dot(straight.derivative, n) * n};
}

DOVETAIL_INLINE vec2 implicit_model::curve_uv(local_id f, int k, double t) const {
  const local_id curve = topology().faces[f].coedges[k].curve;
  return frame_of(f).flat(curve_point(curve, t));
}

DOVETAIL_INLINE vec3 implicit_model::face_point(local_id f, vec2 uv) const {
  const vec3 start = data_->start.face_point(f, uv);
  return data_->function.project_along(start, frame_of(f).n, data_->reach).value_or(start);
}

DOVETAIL_INLINE surface_frame implicit_model::face_frame(local_id f, vec2 uv) const {
  const vec3 start = data_->start.face_point(f, uv);
  const discrete::chart_frame& frame = frame_of(f);
  const auto p = data_->function.project_along(start, frame.n, data_->reach);
  if (!p) // beyond the face, where no part of the surface lies over the plane
    return data_->start.face_frame(f, uv);
  const vec3 g = data_->function.gradient(*p);
  const double up = dot(g, frame.n);
  return {*p, frame.u - (dot(g, frame.u) / up) * frame.n, frame.v - (dot(g, frame.v) / up) * frame.n};
}

DOVETAIL_INLINE double implicit_model::face_curvature(local_id f, vec2 uv) const {
  return data_->function.curvature(face_point(f, uv));
}

DOVETAIL_INLINE vec2 implicit_model::project_to_face(local_id f, vec3 p, vec2 seed) const {
  const discrete::chart_frame& frame = frame_of(f);
  const double same = 1e-10 * data_->bounds.diagonal();
  const vec2 below = frame.flat(p);
  if (distance(face_point(f, below), p) <= same)
    return below;
  if (const auto on_surface = data_->function.project(p, data_->bounds.diagonal())) {
    const vec3 foot = data_->function.nearest(p, *on_surface, data_->bounds.diagonal());
    if (distance(face_point(f, frame.flat(foot)), foot) <= same)
      return frame.flat(foot);
  }
  return data_->start.project_to_face(f, p, seed);
}

DOVETAIL_INLINE double implicit_model::project_to_curve(local_id c, vec3 p, double seed) const {
  const auto& range = topology().curves[c].t;
  double t = data_->start.project_to_curve(c, p, seed);
  for (int step = 0; step < 30; ++step) {
    const auto frame = curve_frame(c, t);
    const double squared = norm_squared(frame.derivative);
    if (!(squared > 0))
      break;
    const double next = std::clamp(t + dot(p - frame.point, frame.derivative) / squared, range[0], range[1]);
    const bool done = std::abs(next - t) <= 1e-14 * (range[1] - range[0]);
    t = next;
    if (done)
      break;
  }
  return t;
}

DOVETAIL_INLINE implicit_model::implicit_model(std::function<double(vec3)> value, const box3& box,
                                               const implicit_options& options, int) {
  level_set function(std::move(value), options.gradient, box.diagonal());
  level_set_triangulation triangulation(function, box, options.resolution);
  const triangle_soup soup = triangulation.run();
  const std::string name = "the implicit surface at resolution " + std::to_string(options.resolution) +
                           " (raise it, or round sharp edges)";
  discrete_model start(repaired(soup, name), {.feature_angle_deg = 180});
  auto made = std::make_shared<data>(
      data{std::move(function), start, start.topology(), start.bounds(), 2 * triangulation.cell_width()});
  const double bulge = 0.1 * triangulation.cell_width(); // of the surface beyond its triangles
  made->bounds.lower -= vec3{bulge, bulge, bulge};
  made->bounds.upper += vec3{bulge, bulge, bulge};
  data_ = made;
  for (auto& vertex : made->topology.vertices)
    vertex.point = carried(vertex.point);
}

DOVETAIL_INLINE const box3& implicit_model::checked(const box3& box, const implicit_options& options) {
  const vec3 extent = box.upper - box.lower;
  if (!(extent.x > 0 && extent.y > 0 && extent.z > 0))
    throw geometry_error("the box of the implicit body is empty; give a box with lower < upper");
  if (options.resolution < 4 || options.resolution > 1000)
    throw geometry_error("the resolution of the implicit body is " + std::to_string(options.resolution) +
                         "; give 4 to 1000 cells");
  return box;
}

DOVETAIL_INLINE const discrete::chart_frame& implicit_model::frame_of(local_id f) const {
  return data_->start.surface().frames[f];
}

DOVETAIL_INLINE vec3 implicit_model::carried(vec3 p) const {
  return data_->function.project(p, data_->reach).value_or(p);
}

#ifdef DOVETAIL_COMPILED
template any_geometry::any_geometry(implicit_model);
#endif

} // namespace dovetail
