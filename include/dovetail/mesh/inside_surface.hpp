/// @file
/// Is a point inside a closed triangulated surface?
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace dovetail {

/// Counts the triangles that a ray along an axis crosses: inside when that is odd, whatever the orientation
/// of the triangles; a void within the surface is outside. Every edge is tested by one expression on its two
/// ends in a fixed order, so the two triangles at it agree and a ray never slips between them nor hits both.
/// The axis is the one along which rays meet the fewest triangles, so that those at a thin sheet pass through
/// it rather than along it. Leave out material interfaces inside the body. O(log n) per query for reasonable
/// surfaces. Throws `geometry_error` when an edge has an odd number of triangles.
class inside_surface {
public:
  explicit inside_surface(simplicial_mesh<2> surface);

  box3 bounds() const { return bounds_; }                          ///< the box around the surface
  std::size_t triangle_count() const { return triangles_.size(); } ///< how many triangles it has

  /// Whether a point is inside.
  bool operator()(vec3 p) const;

  /// The volume enclosed, by the divergence theorem, of a surface whose triangles are oriented outwards.
  double signed_volume_inside() const;

  /// May the triangle have a point in the box? False only when its box or its plane misses the box.
  bool may_meet(local_id triangle, const box3& box) const;

private:
  /// A place with its coordinates in cyclic order, from the axis of the rays on.
  vec3 turned(vec3 p) const {
    return axis_ == 0 ? p : axis_ == 1 ? vec3{p.y, p.z, p.x} : vec3{p.z, p.x, p.y};
  }
  std::array<vec3, 3> corners(std::size_t t) const {
    const auto& v = triangles_[t];
    return {points_[v[0]], points_[v[1]], points_[v[2]]};
  }
  box3 box_of(std::size_t t) const;

  void require_closed() const;
  /// The axis along which a ray at random meets the fewest boxes of triangles.
  int axis_of_few_crossings(const std::vector<box3>& boxes) const;

  /// Seen along the rays: is p left of the edge from the smaller to the larger vertex id? Ties count as not.
  bool left_of_edge(local_id from, local_id to, vec3 p) const;
  /// Does the ray from p, turned, cross the triangle? It goes up the axis (`ahead`) or down.
  bool crossed(std::size_t t, vec3 p, bool ahead) const;

  std::vector<vec3> points_;
  std::vector<simplex<2>> triangles_;
  box3 bounds_;
  int axis_ = 0;
  std::vector<vec3> turned_points_;
  box_tree turned_boxes_; ///< of the triangles
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/inside_surface.ipp"
#endif
