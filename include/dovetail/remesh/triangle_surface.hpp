/// @file
/// The surface of a curved interface face: a straight triangle whose edges are replaced by curved polylines.
#pragma once

#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/surfaces.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::remesh {

/// A smooth curve of displacements over [0, 1] through given nodes (cubic Hermite, slopes from neighbours).
class displacement_curve {
public:
  displacement_curve() = default;
  /// `at` grows from 0 to 1; `values` begin and end with zero. Empty for no displacement.
  displacement_curve(std::vector<double> at, std::vector<vec3> values);

  bool straight() const { return at_.size() < 3; } ///< whether it has no displacements

  /// Value and derivative at s, which is held in [0, 1].
  std::pair<vec3, vec3> operator()(double s) const;

private:
  std::vector<double> at_;
  std::vector<vec3> values_;
  std::vector<vec3> slopes_;
};

/// The straight triangle plus the displacements of its edges, blended to the inside: on an edge exactly the
/// edge's own, at a corner zero, fading as the square of the distance from the opposite corner. Parameters
/// are coordinates in the straight triangle's plane (first corner at the origin, first edge along u).
class triangle_surface {
public:
  /// `sides[i]` lists the points of the side opposite corner i, both ends included, from corner i+1 to corner
  /// i+2 (mod 3); an empty list is a straight side without inner points.
  triangle_surface(const std::array<vec3, 3>& corners, const std::array<std::vector<vec3>, 3>& sides);

  surface_frame frame(vec2 uv) const;

  /// Newton steps from the seed towards the point whose tangential distance from p vanishes.
  vec2 project(vec3 p, vec2 seed) const;

  /// Parameters of point j of side i.
  vec2 side_uv(std::size_t i, std::size_t j) const {
    const double s = side_at_[i][j];
    return (1 - s) * corner_uv_[(i + 1) % 3] + s * corner_uv_[(i + 2) % 3];
  }
  vec2 corner_uv(std::size_t i) const { return corner_uv_[i]; } ///< the parameters of corner `i`

private:
  std::array<double, 3> barycentric(vec2 uv) const;

  void add_side(std::size_t i, const std::vector<vec3>& points);

  plane_surface plane_;
  std::array<vec2, 3> corner_uv_;
  std::array<vec2, 3> weight_gradient_; ///< of the barycentric coordinates
  std::array<std::vector<double>, 3> side_at_;
  std::array<displacement_curve, 3> displacement_;
};

/// Segments from each of so many points to the next, and from the last to the first.
std::vector<simplex<1>> segments_around(std::size_t points);

/// The boundary of a whole interface face, counter-clockwise. `sides` as for `triangle_surface`, every one
/// with at least its two ends; `labels[i]` names the points of side i in the same order.
patch_boundary triangle_boundary(const triangle_surface& surface,
                                 const std::array<std::vector<vec3>, 3>& sides,
                                 const std::array<std::vector<local_id>, 3>& labels);

} // namespace dovetail::remesh

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/triangle_surface.ipp"
#endif
