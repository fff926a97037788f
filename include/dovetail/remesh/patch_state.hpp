/// @file
/// The working state of the patch remesher: a triangulation of the scaled parameter plane, valid at every
/// step, whose vertices carry their surface frame and target size.
///
/// Two measures rule all operations: a triangle must be positively oriented in the parameter plane, exactly,
/// and its quality in 3-space should grow.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/remesh/constrained_triangulation.hpp"
#include "dovetail/remesh/patch.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace dovetail::detail {

/// sin^2 of the smallest angle of a triangle; 0.75 when equilateral, 0 when degenerate.
inline double shape_quality(vec3 a, vec3 b, vec3 c) {
  const vec3 ab = b - a, bc = c - b, ca = a - c;
  const double x = norm_squared(ab), y = norm_squared(bc), z = norm_squared(ca);
  const double two_longest = std::max({x * y, y * z, z * x});
  return two_longest > 0 ? norm_squared(cross(ab, bc)) / two_longest : 0.0;
}

/// Quality that also judges the triangle's normal: `shape_quality` where it agrees with the given surface
/// normal direction (any length), otherwise a negative number that grows with the agreement.
inline double oriented_quality(vec3 a, vec3 b, vec3 c, vec3 normal) {
  constexpr double least_cosine = 0.15;
  const vec3 ab = b - a, bc = c - b, ca = a - c;
  const vec3 area = cross(ab, bc);
  const double x = norm_squared(ab), y = norm_squared(bc), z = norm_squared(ca);
  const double two_longest = std::max({x * y, y * z, z * x});
  if (!(two_longest > 0))
    return -1;
  const double area_squared = norm_squared(area);
  const double along = dot(area, normal);
  const double full = area_squared * norm_squared(normal);
  if (along > 0 && along * along >= least_cosine * least_cosine * full)
    return area_squared / two_longest;
  return full > 0 ? along / std::sqrt(full) - 1 : 0.0;
}

/// The triangulation and its geometry. Vertices [0, frozen) are those of the boundary.
template <patch_surface S>
class patch_state {
public:
  const S& surface;
  const any_sizing& sizing;
  vec2 scale{1, 1}; ///< scaled parameters = scale * uv, so that lengths resemble those in 3-space
  corner_table table;
  std::vector<vec2> xy; ///< scaled parameters
  std::vector<vec3> point;
  std::vector<vec3> du, dv;       ///< derivatives by the scaled parameters
  std::vector<vec3> normal;       ///< unit surface normal, or zero where the surface is singular
  std::vector<double> size;       ///< target edge length
  std::vector<local_id> label;    ///< of boundary vertices; no_id for inner ones
  std::vector<std::uint8_t> pole; ///< 1 at a vertex of a pole
  std::vector<double> misfit;     ///< of boundary vertices: distance from the surface at their parameters
  double extent = 0;              ///< diagonal of the boundary's bounding box
  local_id frozen = 0;

  patch_state(const S& s, const any_sizing& h) : surface(s), sizing(h) {}

  static constexpr std::size_t at(local_id i) { return static_cast<std::size_t>(i); }
  bool inner(local_id v) const { return v >= frozen; }

  surface_frame frame_at(vec2 scaled) const {
    surface_frame f = surface.frame({scaled.x / scale.x, scaled.y / scale.y});
    f.du = f.du / scale.x;
    f.dv = f.dv / scale.y;
    return f;
  }

  local_id add_vertex(vec2 scaled, const surface_frame& f, double target) {
    const local_id v = table.add_vertex();
    xy.push_back(scaled);
    point.push_back(f.point);
    du.push_back(f.du);
    dv.push_back(f.dv);
    normal.push_back(normalized(cross(f.du, f.dv)));
    size.push_back(target);
    label.push_back(no_id);
    pole.push_back(0);
    return v;
  }
  void place(local_id v, vec2 scaled, const surface_frame& f) {
    xy[at(v)] = scaled;
    point[at(v)] = f.point;
    du[at(v)] = f.du;
    dv[at(v)] = f.dv;
    normal[at(v)] = normalized(cross(f.du, f.dv));
  }

  /// The step in scaled parameters that moves along the tangential part of `step`; zero where singular.
  static vec2 parameter_step(const vec3& along_u, const vec3& along_v, vec3 step) {
    const double uu = dot(along_u, along_u), uv = dot(along_u, along_v), vv = dot(along_v, along_v);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv))
      return {0, 0};
    const double su = dot(along_u, step), sv = dot(along_v, step);
    return {(vv * su - uv * sv) / determinant, (uu * sv - uv * su) / determinant};
  }

  bool positive(local_id a, local_id b, local_id c) const {
    return orient2d(xy[at(a)], xy[at(b)], xy[at(c)]) > 0;
  }
  /// True for a triangle that exists in the parameter plane only, as it has a side on a pole.
  bool vanishes(local_id a, local_id b, local_id c) const {
    return (pole[at(a)] && ((pole[at(b)] && label[at(a)] == label[at(b)]) ||
                            (pole[at(c)] && label[at(a)] == label[at(c)]))) ||
           (pole[at(b)] && pole[at(c)] && label[at(b)] == label[at(c)]);
  }
  /// Quality of a triangle over existing vertices.
  double quality(local_id a, local_id b, local_id c) const {
    if (a < frozen || b < frozen || c < frozen)
      if (vanishes(a, b, c))
        return 0.75;
    return oriented_quality(point[at(a)], point[at(b)], point[at(c)],
                            normal[at(a)] + normal[at(b)] + normal[at(c)]);
  }
  double quality(local_id t) const {
    return quality(table.vertex[at(3 * t)], table.vertex[at(3 * t + 1)], table.vertex[at(3 * t + 2)]);
  }

  /// True for a triangle with a boundary edge that is shorter than the accuracy of its ends, or next to
  /// nothing beside the whole patch: its normal is noise.
  bool within_misfit(local_id t) const {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id a = table.tail(c), b = table.head(c);
      if (a < frozen && b < frozen &&
          length(a, b) <= std::max(2 * (misfit[at(a)] + misfit[at(b)]), 1e-6 * extent))
        return true;
    }
    return false;
  }

  /// The target edge length at p. Fronts that meet leave no room for a last row of full-size triangles, so
  /// edges come out shorter than asked by a few per cent; the factor makes up for it.
  double target_size(vec3 p) const { return calibration * sizing(p); }
  static constexpr double calibration = 1.045;

  double length(local_id a, local_id b) const { return distance(point[at(a)], point[at(b)]); }
  double target(local_id a, local_id b) const { return 0.5 * (size[at(a)] + size[at(b)]); }
  /// Edge length relative to the target.
  double relative_length(local_id a, local_id b) const { return length(a, b) / target(a, b); }

  /// A list that operations may use while they run; kept to avoid allocation in loops.
  std::vector<local_id>& ring_scratch() { return ring_; }

  bool may_flip(local_id c) const {
    if (!table.free_side(c))
      return false;
    const local_id d = table.twin[at(c)];
    const local_id p = table.vertex[at(c)], q = table.vertex[at(d)];
    return positive(p, table.tail(c), q) && positive(q, table.head(c), p);
  }

private:
  std::vector<local_id> ring_;
};

} // namespace dovetail::detail
