/// @file
/// What `background.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/bytes.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/background.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE background_field::background_field(simplicial_mesh<3> mesh, std::vector<double> sizes)
    : points_(std::move(mesh.points)), elements_(std::move(mesh.elements)), sizes_(std::move(sizes)) {
  check(elements_, "tetrahedron");
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const auto& n = elements_[e];
    if (signed_volume(point(n[0]), point(n[1]), point(n[2]), point(n[3])) == 0)
      throw sizing_error("element " + std::to_string(e) + " of the background mesh is flat; remove it");
  }
  collect_boundary();
  plant_trees();
}

DOVETAIL_INLINE background_field background_field::decode(byte_reader& from) {
  simplicial_mesh<3> mesh;
  mesh.points = from.array<vec3>();
  mesh.elements = from.array<simplex<3>>();
  return {std::move(mesh), from.array<double>()};
}

DOVETAIL_INLINE double background_field::operator()(vec3 p) const {
  if (const auto inside = interpolated(p))
    return *inside;
  const nearest_boundary at = nearest(p);
  const auto& side = boundary_[at.side];
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i)
    size += at.weights[i] * size_of(side[i]);
  return size;
}

DOVETAIL_INLINE double background_field::smallest_size_in(const box3& box) const {
  double least = std::numeric_limits<double>::infinity();
  const vec3 center = box.center();
  const double radius = 0.5 * box.diagonal();
  element_tree_.for_each([&](const box3& b, std::size_t) { return b.overlaps(box); },
                         [&](local_id e) { least = std::min(least, bound_of_element(e, center, radius)); });
  // Points of the box that are outside the mesh take the value of a boundary triangle: of one at most that
  // far away.
  const double to_boundary = nearest(center).distance;
  if (to_boundary <= radius || !interpolated(center)) {
    const double within = to_boundary + 2 * radius;
    boundary_tree_.for_each(
        [&](const box3& b, std::size_t) { return distance_squared(b, center) <= within * within; },
        [&](local_id side) {
          for (const local_id node : boundary_[side])
            least = std::min(least, size_of(node));
        });
  }
  return least * (1 - 1e-12);
}

DOVETAIL_INLINE std::array<double, 4> background_field::barycentric(const simplex<3>& e, vec3 p) const {
  const vec3 a = point(e[0]);
  const vec3 b = point(e[1]);
  const vec3 c = point(e[2]);
  const vec3 d = point(e[3]);
  const double whole = signed_volume(a, b, c, d);
  return {signed_volume(p, b, c, d) / whole, signed_volume(a, p, c, d) / whole,
          signed_volume(a, b, p, d) / whole, signed_volume(a, b, c, p) / whole};
}

DOVETAIL_INLINE std::optional<double> background_field::interpolated(vec3 p) const {
  double deepest = -1e-12;
  std::optional<double> value;
  element_tree_.for_each([&](const box3& box, std::size_t) { return contains(box, p); },
                         [&](local_id id) {
                           const auto& e = elements_[id];
                           const auto weights = barycentric(e, p);
                           const double depth = *std::min_element(weights.begin(), weights.end());
                           if (depth < deepest || (value && depth == deepest))
                             return;
                           deepest = depth;
                           double sum = 0;
                           double total = 0;
                           for (std::size_t i = 0; i < 4; ++i) {
                             sum += std::max(weights[i], 0.0) * size_of(e[i]);
                             total += std::max(weights[i], 0.0);
                           }
                           value = sum / total;
                         });
  return value;
}

DOVETAIL_INLINE background_field::nearest_boundary background_field::nearest(vec3 p) const {
  nearest_boundary best;
  boundary_tree_.for_each_near(
      p,
      [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best.distance * best.distance; },
      [&](local_id id) {
        const auto index = static_cast<std::size_t>(id);
        const auto& side = boundary_[index];
        const auto w = nearest_on_triangle(point(side[0]), point(side[1]), point(side[2]), p);
        const double away =
            distance(p, w[0] * point(side[0]) + w[1] * point(side[1]) + w[2] * point(side[2]));
        if (away < best.distance || (away == best.distance && index < best.side))
          best = {index, w, away};
      });
  return best;
}

DOVETAIL_INLINE double background_field::bound_of_element(local_id id, vec3 center, double radius) const {
  const auto& e = elements_[id];
  const vec3 a = point(e[0]);
  const vec3 b = point(e[1]) - a;
  const vec3 c = point(e[2]) - a;
  const vec3 d = point(e[3]) - a;
  const double least = std::min({size_of(e[0]), size_of(e[1]), size_of(e[2]), size_of(e[3])});
  const double six_volumes = dot(cross(b, c), d);
  const vec3 gradient = (1 / six_volumes) * ((size_of(e[1]) - size_of(e[0])) * cross(c, d) +
                                             (size_of(e[2]) - size_of(e[0])) * cross(d, b) +
                                             (size_of(e[3]) - size_of(e[0])) * cross(b, c));
  return std::max(least, size_of(e[0]) + dot(gradient, center - a) - norm(gradient) * radius);
}

DOVETAIL_INLINE void background_field::plant_trees() {
  const auto boxes_of = [this](const auto& simplices) {
    std::vector<box3> boxes;
    boxes.reserve(simplices.size());
    for (const auto& nodes : simplices)
      boxes.push_back(box_of(nodes));
    return boxes;
  };
  element_tree_ = box_tree(boxes_of(elements_));
  boundary_tree_ = box_tree(boxes_of(boundary_));
}

DOVETAIL_INLINE void background_field::collect_boundary() {
  const auto sides = build_sides<3>(span_of(elements_), points_.size());
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (sides.is_boundary(static_cast<local_id>(i)))
      boundary_.push_back(sides.vertices[i]);
}

} // namespace dovetail
