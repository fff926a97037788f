/// @file
/// What `inside_surface.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/inside_surface.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE inside_surface::inside_surface(simplicial_mesh<2> surface)
    : points_(std::move(surface.points)), triangles_(std::move(surface.elements)) {
  require_closed();
  std::vector<box3> boxes;
  boxes.reserve(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    boxes.push_back(box_of(t));
  tree_ = box_tree(boxes);
}

DOVETAIL_INLINE bool inside_surface::operator()(vec3 p) const {
  bool inside = false;
  tree_.for_each(
      [&](const box3& box, std::size_t) {
        return p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z &&
               p.z <= box.upper.z;
      },
      [&](local_id t) { inside = inside != crossed(static_cast<std::size_t>(t), p); });
  return inside;
}

DOVETAIL_INLINE double inside_surface::signed_volume_inside() const {
  const vec3 origin = bounds().center();
  double sum = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto [a, b, c] = corners(t);
    sum += signed_volume(origin, a, b, c);
  }
  return sum;
}

DOVETAIL_INLINE bool inside_surface::may_meet(local_id triangle, const box3& box) const {
  const auto t = static_cast<std::size_t>(triangle);
  if (!box_of(t).overlaps(box))
    return false;
  const auto [a, b, c] = corners(t);
  const vec3 n = cross(b - a, c - a);
  const vec3 half = 0.5 * (box.upper - box.lower);
  const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
  return std::abs(dot(n, box.center() - a)) <= reach * (1 + 1e-9);
}

DOVETAIL_INLINE box3 inside_surface::box_of(std::size_t t) const {
  box3 box;
  for (const vec3& p : corners(t))
    box.include(p);
  return box;
}

DOVETAIL_INLINE void inside_surface::require_closed() const {
  if (triangles_.empty())
    throw geometry_error("the surface has no triangle; give a closed surface");
  const auto sides = build_sides<2>(span_of(triangles_), points_.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const std::size_t count = sides.all_elements(static_cast<local_id>(i)).size();
    if (sides.is_boundary(static_cast<local_id>(i)) || count % 2 != 0) {
      const vec3 at = points_[sides.vertices[i][0]];
      throw geometry_error("the surface is open at the edge near " + place_text(at) + "; close it");
    }
  }
}

DOVETAIL_INLINE bool inside_surface::left_of_edge(local_id from, local_id to, vec3 p) const {
  const bool turned = from > to;
  const vec3 a = points_[turned ? to : from];
  const vec3 b = points_[turned ? from : to];
  const bool left = (b.y - a.y) * (p.z - a.z) - (b.z - a.z) * (p.y - a.y) > 0;
  return left != turned;
}

DOVETAIL_INLINE bool inside_surface::crossed(std::size_t t, vec3 p) const {
  const auto& v = triangles_[t];
  const bool ab = left_of_edge(v[0], v[1], p);
  if (left_of_edge(v[1], v[2], p) != ab || left_of_edge(v[2], v[0], p) != ab)
    return false;
  const auto [a, b, c] = corners(t);
  const vec3 n = cross(b - a, c - a);
  // The plane is met at x = p.x - dot(n, p - a) / n.x.
  return n.x != 0 && (dot(n, p - a) < 0) == (n.x > 0);
}

} // namespace dovetail
