/// @file
/// A body given by a function of space as a geometry model: experiments need no file.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/discrete/charted_surface.hpp"

#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

namespace dovetail {

/// How a function becomes a model.
struct implicit_options {
  int resolution = 48; ///< cells of the start triangulation along the longest side of the box
  /// Of the function; central differences when there is none.
  std::function<vec3(vec3)> gradient = {};
};

/// A model of `geometry_model` for the body where a function is negative. The function is any callable from
/// vec3 to double, continuously differentiable near its zero set; a signed distance is best, but any will do.
/// A triangulation gives the topology: charts as of a `discrete_model`, whose points are then carried onto
/// the zero set by Newton's method, along the chart's normal inside a face and along the gradient on a curve.
/// What is thinner than about two cells is not resolved, nor are edges sharper than a radius of about two
/// cells: the triangulation then crosses itself, or faces cannot be meshed. Queries may run in several
/// threads when the function may. Copies are cheap.
class implicit_model {
public:
  /// Throws `geometry_error` when the body is empty, reaches the border of the box, or its surface cannot be
  /// triangulated at this resolution.
  template <class F>
    requires(std::invocable<const F&, vec3>)
  implicit_model(F value, const box3& box, const implicit_options& options = {})
      : implicit_model(std::function<double(vec3)>(std::move(value)), checked(box, options), options, 0) {}

  const geometry_topology& topology() const;
  box3 bounds() const;
  bool thread_safe() const { return true; }
  /// The start triangulation, split into charts; `chart_of` is the face of each triangle.
  const charted_surface& surface() const;

  vec3 curve_point(local_id c, double t) const;
  dovetail::curve_frame curve_frame(local_id c, double t) const;
  vec2 curve_uv(local_id f, int k, double t) const;

  vec3 face_point(local_id f, vec2 uv) const;
  surface_frame face_frame(local_id f, vec2 uv) const;
  double face_curvature(local_id f, vec2 uv) const;

  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const;

  double project_to_curve(local_id c, vec3 p, double seed) const;

private:
  struct data;

  implicit_model(std::function<double(vec3)> value, const box3& box, const implicit_options& options, int);

  static const box3& checked(const box3& box, const implicit_options& options);

  const discrete::chart_frame& frame_of(local_id f) const;
  vec3 carried(vec3 p) const;

  std::shared_ptr<const data> data_;
};

static_assert(geometry_model<implicit_model>);

#ifdef DOVETAIL_COMPILED
extern template any_geometry::any_geometry(implicit_model);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/implicit_model.ipp"
#endif
