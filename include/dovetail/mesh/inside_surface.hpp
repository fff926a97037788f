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

/// Counts, along a ray in the direction of +x, the triangles it crosses: inside when that is odd, whatever
/// the orientation of the triangles; a void within the surface is outside. Every edge is tested by one
/// expression on its two ends in a fixed order, so the two triangles at it agree and a ray never slips
/// between them nor hits both. Leave out material interfaces inside the body. O(log n) per query for
/// reasonable surfaces. Throws `geometry_error` when an edge has an odd number of triangles.
class inside_surface {
public:
  explicit inside_surface(simplicial_mesh<2> surface);

  box3 bounds() const { return tree_.bounds(); } ///< the box around the surface
  const box_tree& tree() const { return tree_; } ///< the boxes of its triangles

  /// Whether a point is inside.
  bool operator()(vec3 p) const;

  /// The volume enclosed, by the divergence theorem, of a surface whose triangles are oriented outwards.
  double signed_volume_inside() const;

  /// May the triangle have a point in the box? False only when its box or its plane misses the box.
  bool may_meet(local_id triangle, const box3& box) const;

private:
  std::array<vec3, 3> corners(std::size_t t) const {
    const auto& v = triangles_[t];
    return {points_[v[0]], points_[v[1]], points_[v[2]]};
  }
  box3 box_of(std::size_t t) const;

  void require_closed() const;

  /// Seen along x: is p's (y, z) left of the edge from the smaller to the larger vertex id? Ties count as
  /// not.
  bool left_of_edge(local_id from, local_id to, vec3 p) const;

  bool crossed(std::size_t t, vec3 p) const;

  std::vector<vec3> points_;
  std::vector<simplex<2>> triangles_;
  box_tree tree_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/inside_surface.ipp"
#endif
