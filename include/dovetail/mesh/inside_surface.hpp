/// @file
/// Is a point inside a closed triangulated surface?
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Counts, along a ray in the direction of +x, the triangles it crosses: inside when that is odd, whatever
/// the orientation of the triangles; a void within the surface is outside. Every edge is tested by one
/// expression on its two ends in a fixed order, so the two triangles at it agree and a ray never slips
/// between them nor hits both. Leave out material interfaces inside the body. O(log n) per query for
/// reasonable surfaces. Throws `geometry_error` when an edge has an odd number of triangles.
class inside_surface {
public:
  explicit inside_surface(simplicial_mesh<2> surface)
      : points_(std::move(surface.points)), triangles_(std::move(surface.elements)) {
    require_closed();
    std::vector<box3> boxes;
    boxes.reserve(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      boxes.push_back(box_of(t));
    tree_ = box_tree(boxes);
  }

  box3 bounds() const { return tree_.bounds(); } ///< the box around the surface
  const box_tree& tree() const { return tree_; } ///< the boxes of its triangles

  /// Whether a point is inside.
  bool operator()(vec3 p) const {
    bool inside = false;
    tree_.for_each(
        [&](const box3& box, std::size_t) {
          return p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z &&
                 p.z <= box.upper.z;
        },
        [&](local_id t) { inside = inside != crossed(static_cast<std::size_t>(t), p); });
    return inside;
  }

  /// The volume enclosed, by the divergence theorem, of a surface whose triangles are oriented outwards.
  double signed_volume_inside() const {
    const vec3 origin = bounds().center();
    double sum = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto [a, b, c] = corners(t);
      sum += signed_volume(origin, a, b, c);
    }
    return sum;
  }

  /// May the triangle have a point in the box? False only when its box or its plane misses the box.
  bool may_meet(local_id triangle, const box3& box) const {
    const auto t = static_cast<std::size_t>(triangle);
    if (!box_of(t).overlaps(box))
      return false;
    const auto [a, b, c] = corners(t);
    const vec3 n = cross(b - a, c - a);
    const vec3 half = 0.5 * (box.upper - box.lower);
    const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
    return std::abs(dot(n, box.center() - a)) <= reach * (1 + 1e-9);
  }

private:
  std::array<vec3, 3> corners(std::size_t t) const {
    const auto& v = triangles_[t];
    return {points_[static_cast<std::size_t>(v[0])], points_[static_cast<std::size_t>(v[1])],
            points_[static_cast<std::size_t>(v[2])]};
  }
  box3 box_of(std::size_t t) const {
    box3 box;
    for (const vec3& p : corners(t))
      box.include(p);
    return box;
  }

  void require_closed() const {
    if (triangles_.empty())
      throw geometry_error("the surface has no triangle; give a closed surface");
    const auto sides = build_sides<2>(span_of(triangles_), points_.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const std::size_t count = sides.all_elements(static_cast<local_id>(i)).size();
      if (sides.is_boundary(static_cast<local_id>(i)) || count % 2 != 0) {
        const vec3 at = points_[static_cast<std::size_t>(sides.vertices[i][0])];
        throw geometry_error("the surface is open at the edge near " + place_text(at) + "; close it");
      }
    }
  }

  /// Seen along x: is p's (y, z) left of the edge from the smaller to the larger vertex id? Ties count as
  /// not.
  bool left_of_edge(local_id from, local_id to, vec3 p) const {
    const bool turned = from > to;
    const vec3 a = points_[static_cast<std::size_t>(turned ? to : from)];
    const vec3 b = points_[static_cast<std::size_t>(turned ? from : to)];
    const bool left = (b.y - a.y) * (p.z - a.z) - (b.z - a.z) * (p.y - a.y) > 0;
    return left != turned;
  }

  bool crossed(std::size_t t, vec3 p) const {
    const auto& v = triangles_[t];
    const bool ab = left_of_edge(v[0], v[1], p);
    if (left_of_edge(v[1], v[2], p) != ab || left_of_edge(v[2], v[0], p) != ab)
      return false;
    const auto [a, b, c] = corners(t);
    const vec3 n = cross(b - a, c - a);
    // The plane is met at x = p.x - dot(n, p - a) / n.x.
    return n.x != 0 && (dot(n, p - a) < 0) == (n.x > 0);
  }

  std::vector<vec3> points_;
  std::vector<simplex<2>> triangles_;
  box_tree tree_;
};

} // namespace dovetail
