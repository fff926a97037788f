/// @file
/// What `triangle_surface.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/remesh/triangle_surface.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::remesh {

DOVETAIL_INLINE displacement_curve::displacement_curve(std::vector<double> at, std::vector<vec3> values)
    : at_(std::move(at)), values_(std::move(values)), slopes_(at_.size()) {
  const std::size_t n = at_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t left = i == 0 ? 0 : i - 1, right = i + 1 == n ? i : i + 1;
    slopes_[i] = (values_[right] - values_[left]) / (at_[right] - at_[left]);
  }
}

DOVETAIL_INLINE std::pair<vec3, vec3> displacement_curve::operator()(double s) const {
  if (straight())
    return {};
  s = std::clamp(s, 0.0, 1.0);
  auto right = static_cast<std::size_t>(std::upper_bound(at_.begin(), at_.end(), s) - at_.begin());
  right = std::clamp<std::size_t>(right, 1, at_.size() - 1);
  const std::size_t left = right - 1;
  const double width = at_[right] - at_[left], x = (s - at_[left]) / width;
  const double y = 1 - x;
  const vec3 a = values_[left], b = values_[right], p = width * slopes_[left], q = width * slopes_[right];
  const vec3 value =
      (y * y * (1 + 2 * x)) * a + (x * y * y) * p + (x * x * (1 + 2 * y)) * b + (-x * x * y) * q;
  const vec3 slope = (6 * x * y) * (b - a) + (y * (1 - 3 * x)) * p + (x * (3 * x - 2)) * q;
  return {value, slope / width};
}

DOVETAIL_INLINE triangle_surface::triangle_surface(const std::array<vec3, 3>& corners,
                                                   const std::array<std::vector<vec3>, 3>& sides)
    : plane_(plane_surface::of_triangle(corners[0], corners[1], corners[2])) {
  for (std::size_t i = 0; i < 3; ++i)
    corner_uv_[i] = plane_.project(corners[i]);
  const double area = cross(corner_uv_[1] - corner_uv_[0], corner_uv_[2] - corner_uv_[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const vec2 side = corner_uv_[(i + 2) % 3] - corner_uv_[(i + 1) % 3];
    weight_gradient_[i] = {-side.y / area, side.x / area};
    add_side(i, sides[i]);
  }
}

DOVETAIL_INLINE surface_frame triangle_surface::frame(vec2 uv) const {
  const std::array<double, 3> weight = barycentric(uv);
  surface_frame f = plane_.frame(uv);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3; // the side runs from corner j to corner k
    const double both = weight[j] + weight[k];
    if (displacement_[i].straight() || !(both > 1e-14))
      continue;
    const auto [value, slope] = displacement_[i](weight[k] / both);
    f.point += (both * both) * value;
    const vec3 by_j = (2 * both) * value - weight[k] * slope, by_k = (2 * both) * value + weight[j] * slope;
    f.du += weight_gradient_[j].x * by_j + weight_gradient_[k].x * by_k;
    f.dv += weight_gradient_[j].y * by_j + weight_gradient_[k].y * by_k;
  }
  return f;
}

DOVETAIL_INLINE vec2 triangle_surface::project(vec3 p, vec2 seed) const {
  for (int step = 0; step < 20; ++step) {
    const surface_frame f = frame(seed);
    const double uu = dot(f.du, f.du), uv = dot(f.du, f.dv), vv = dot(f.dv, f.dv);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv))
      break;
    const double u = dot(f.du, p - f.point), v = dot(f.dv, p - f.point);
    const vec2 move{(vv * u - uv * v) / determinant, (uu * v - uv * u) / determinant};
    seed = seed + move;
    if (norm(move) < 1e-13 * norm(corner_uv_[1]))
      break;
  }
  return seed;
}

DOVETAIL_INLINE std::array<double, 3> triangle_surface::barycentric(vec2 uv) const {
  std::array<double, 3> weight;
  for (std::size_t i = 0; i < 3; ++i)
    weight[i] = dot(weight_gradient_[i], uv - corner_uv_[(i + 1) % 3]);
  return weight;
}

DOVETAIL_INLINE void triangle_surface::add_side(std::size_t i, const std::vector<vec3>& points) {
  std::vector<double>& at = side_at_[i];
  at = {0, 1};
  if (points.size() < 3)
    return;
  at.assign(points.size(), 0);
  for (std::size_t j = 1; j < points.size(); ++j)
    at[j] = at[j - 1] + distance(points[j - 1], points[j]);
  for (double& s : at)
    s /= at.back();
  at.back() = 1;
  std::vector<vec3> displacement(points.size());
  const vec3 first = points.front(), last = points.back();
  for (std::size_t j = 1; j + 1 < points.size(); ++j)
    displacement[j] = points[j] - ((1 - at[j]) * first + at[j] * last);
  displacement_[i] = displacement_curve(at, std::move(displacement));
}

DOVETAIL_INLINE std::vector<simplex<1>> segments_around(std::size_t points) {
  const auto count = static_cast<local_id>(points);
  std::vector<simplex<1>> segments;
  segments.reserve(points);
  for (local_id v = 0; v < count; ++v)
    segments.push_back({v, (v + 1) % count});
  return segments;
}

DOVETAIL_INLINE patch_boundary triangle_boundary(const triangle_surface& surface,
                                                 const std::array<std::vector<vec3>, 3>& sides,
                                                 const std::array<std::vector<local_id>, 3>& labels) {
  patch_boundary boundary;
  for (std::size_t i = 0; i < 3; ++i) { // the last point starts the next side
    boundary.points.insert(boundary.points.end(), sides[i].begin(), sides[i].end() - 1);
    boundary.labels.insert(boundary.labels.end(), labels[i].begin(), labels[i].end() - 1);
    for (std::size_t j = 0; j + 1 < sides[i].size(); ++j)
      boundary.uv.push_back(surface.side_uv(i, j));
  }
  boundary.segments = segments_around(boundary.points.size());
  return boundary;
}

} // namespace dovetail::remesh
