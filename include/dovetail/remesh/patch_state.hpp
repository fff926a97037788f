/// @file
/// The working state of the patch remesher: a triangulation of the scaled parameter plane, valid at every
/// step, whose vertices carry their surface frame and target size.
///
/// Two measures rule all operations: a triangle must be positively oriented in the parameter plane, exactly,
/// and its quality in 3-space should grow.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/mesh/triangle_shape.hpp"
#include "dovetail/remesh/constrained_triangulation.hpp"
#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dovetail::detail {

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

  /// All that a move of a vertex changes.
  struct location {
    vec2 xy;
    vec3 point, du, dv, normal;
  };
  location location_of(local_id v) const { return {xy[v], point[v], du[v], dv[v], normal[v]}; }
  void place(local_id v, const location& where) {
    xy[v] = where.xy;
    point[v] = where.point;
    du[v] = where.du;
    dv[v] = where.dv;
    normal[v] = where.normal;
  }
  /// Where inner vertex v gets by a step in 3-space, if its star stays valid.
  std::optional<location> displaced(local_id v, vec3 step,
                                    std::span<const std::array<local_id, 2>> link) const {
    const vec2 to = xy[v] + parameter_step(du[v], dv[v], step);
    if (to == xy[v])
      return std::nullopt;
    for (const auto& [a, b] : link)
      if (!(orient2d(xy[a], xy[b], to) > 0))
        return std::nullopt;
    const surface_frame f = frame_at(to);
    return location{to, f.point, f.du, f.dv, normalized(cross(f.du, f.dv))};
  }
  /// A unit vector of the surface at v.
  vec3 tangent(local_id v) const { return normalized(du[v]); }

  /// Adds a vertex at the middle of the parameters of the free side opposite c, if both triangles can be
  /// split there. The caller splits the side.
  local_id add_middle(local_id c) {
    const vec2 a = xy[table.tail(c)], b = xy[table.head(c)];
    const vec2 middle = 0.5 * (a + b);
    const vec2 p = xy[table.vertex[c]], q = xy[table.vertex[table.twin[c]]];
    if (!(orient2d(p, a, middle) > 0 && orient2d(b, p, middle) > 0 && orient2d(q, b, middle) > 0 &&
          orient2d(a, q, middle) > 0))
      return no_id;
    return add_vertex(middle, frame_at(middle), target(table.tail(c), table.head(c)));
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

  bool positive(local_id a, local_id b, local_id c) const { return orient2d(xy[a], xy[b], xy[c]) > 0; }
  /// True for a triangle that exists in the parameter plane only, as it has a side on a pole.
  bool vanishes(local_id a, local_id b, local_id c) const {
    return (pole[a] && ((pole[b] && label[a] == label[b]) || (pole[c] && label[a] == label[c]))) ||
           (pole[b] && pole[c] && label[b] == label[c]);
  }
  /// Quality of a triangle over existing vertices.
  double quality(local_id a, local_id b, local_id c) const {
    if (a < frozen || b < frozen || c < frozen)
      if (vanishes(a, b, c))
        return 0.75;
    if constexpr (std::same_as<S, remesh::plane_surface>) // its scaled parameters are lengths
      return oriented_quality(xy[a], xy[b], xy[c]);
    else
      return oriented_quality(point[a], point[b], point[c], normal[a] + normal[b] + normal[c]);
  }
  double quality(local_id t) const {
    return quality(table.vertex[3 * t], table.vertex[3 * t + 1], table.vertex[3 * t + 2]);
  }

  /// True for a triangle with a boundary edge that is shorter than the accuracy of its ends, or next to
  /// nothing beside the whole patch: its normal is noise.
  bool within_misfit(local_id t) const {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id a = table.tail(c), b = table.head(c);
      if (a < frozen && b < frozen && length(a, b) <= std::max(2 * (misfit[a] + misfit[b]), 1e-6 * extent))
        return true;
    }
    return false;
  }

  /// The target edge length at p. Fronts that meet leave no room for a last row of full-size triangles, so
  /// edges come out shorter than asked by a few per cent; the factor makes up for it.
  double target_size(vec3 p) const { return calibration * checked_size(sizing, p); }
  static constexpr double calibration = 1.045;

  double length(local_id a, local_id b) const { return distance(point[a], point[b]); }
  double target(local_id a, local_id b) const { return 0.5 * (size[a] + size[b]); }
  /// Edge length relative to the target.
  double relative_length(local_id a, local_id b) const { return length(a, b) / target(a, b); }

  /// A valid plane triangulation admits whatever leaves it one.
  bool may_collapse(local_id, local_id) const { return true; }

  /// A list that operations may use while they run; kept to avoid allocation in loops.
  std::vector<local_id>& ring_scratch() { return ring_; }

  bool may_flip(local_id c) const {
    if (!table.free_side(c))
      return false;
    const local_id d = table.twin[c];
    const local_id p = table.vertex[c], q = table.vertex[d];
    return positive(p, table.tail(c), q) && positive(q, table.head(c), p);
  }

private:
  std::vector<local_id> ring_;
};

} // namespace dovetail::detail
