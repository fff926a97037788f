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
#include <limits>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE inside_surface::inside_surface(simplicial_mesh<2> surface)
    : points_(std::move(surface.points)), triangles_(std::move(surface.elements)) {
  require_closed();
  std::vector<box3> boxes;
  boxes.reserve(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    boxes.push_back(box_of(t));
    bounds_ = united(bounds_, boxes.back());
  }
  axis_ = axis_of_few_crossings(boxes);
  turned_points_.reserve(points_.size());
  for (const vec3& p : points_)
    turned_points_.push_back(turned(p));
  for (box3& box : boxes)
    box = {turned(box.lower), turned(box.upper)};
  turned_boxes_ = box_tree(boxes);
}

DOVETAIL_INLINE int inside_surface::axis_of_few_crossings(const std::vector<box3>& boxes) const {
  const auto area_across = [](const box3& box, int axis) {
    const vec3 extent = box.upper - box.lower;
    return extent[(axis + 1) % 3] * extent[(axis + 2) % 3];
  };
  int best = 0;
  double fewest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (const box3& box : boxes)
      sum += area_across(box, axis);
    if (const double met = sum / area_across(bounds_, axis); met < fewest) {
      fewest = met;
      best = axis;
    }
  }
  return best;
}

DOVETAIL_INLINE bool inside_surface::operator()(vec3 point) const {
  const vec3 p = turned(point);
  const box3 all = turned_boxes_.bounds();
  const bool ahead = p.x - all.lower.x > all.upper.x - p.x; // where less is in the way
  bool inside = false;
  turned_boxes_.for_each(
      [&](const box3& box, std::size_t) {
        return (ahead ? p.x <= box.upper.x : box.lower.x <= p.x) && box.lower.y <= p.y &&
               p.y <= box.upper.y && box.lower.z <= p.z && p.z <= box.upper.z;
      },
      [&](local_id t) { inside = inside != crossed(static_cast<std::size_t>(t), p, ahead); });
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
  const bool exchanged = from > to;
  const vec3& a = turned_points_[exchanged ? to : from];
  const vec3& b = turned_points_[exchanged ? from : to];
  const bool left = (b.y - a.y) * (p.z - a.z) - (b.z - a.z) * (p.y - a.y) > 0;
  return left != exchanged;
}

DOVETAIL_INLINE bool inside_surface::crossed(std::size_t t, vec3 p, bool ahead) const {
  const auto& v = triangles_[t];
  const bool ab = left_of_edge(v[0], v[1], p);
  if (left_of_edge(v[1], v[2], p) != ab || left_of_edge(v[2], v[0], p) != ab)
    return false;
  const vec3& a = turned_points_[v[0]];
  const vec3 n = cross(turned_points_[v[1]] - a, turned_points_[v[2]] - a);
  // The plane is met at x = p.x - dot(n, p - a) / n.x.
  return n.x != 0 && ((dot(n, p - a) < 0) == (n.x > 0)) == ahead;
}

} // namespace dovetail
