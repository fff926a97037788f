/// @file
/// What `surface_host.hpp` declares.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/improver/surface_host.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE bool is_plane_throughout(const surface_host& host, const std::vector<local_id>& faces) {
  if (!host)
    return true;
  if (!host.plane_normal || faces.empty())
    return false;
  for (std::size_t t = 0; t < faces.size(); ++t)
    if ((t == 0 || faces[t] != faces[t - 1]) && !(norm_squared(host.plane_normal(faces[t])) > 0))
      return false;
  return true;
}

DOVETAIL_INLINE std::vector<simplex<1>> sides_at_poles(const simplicial_mesh<2>& mesh,
                                                       const std::vector<bool>& is_pole) {
  std::vector<simplex<1>> sides;
  for (const auto& [a, b, c] : mesh.elements)
    if (is_pole[a] || is_pole[b] || is_pole[c])
      for (const simplex<1> side : {simplex<1>{a, b}, {b, c}, {c, a}})
        sides.push_back(side);
  return sides;
}

namespace improvement {

DOVETAIL_INLINE triangle_host::triangle_host(std::vector<vec3> points, std::vector<simplex<2>> triangles,
                                             std::vector<vec3> normals)
    : points_(std::move(points)), triangles_(std::move(triangles)), normals_(std::move(normals)),
      around_(sorted_into_rows<local_id>(points_.size(), [this](const auto& put) {
        for (std::size_t t = 0; t < triangles_.size(); ++t)
          for (const local_id v : triangles_[t])
            put(v, static_cast<local_id>(t));
      })) {}

DOVETAIL_INLINE host_point triangle_host::project(vec3 p, local_id& on) const {
  found best = nearest(on, p);
  for (int step = 0; step < most_steps; ++step) {
    const auto& inside = best.weights;
    if (inside[0] > 0 && inside[1] > 0 && inside[2] > 0)
      break;
    const local_id from = on;
    for (const local_id v : triangles_[from])
      for (const local_id t : around_[v])
        if (const found other = nearest(t, p); other.distance_squared < best.distance_squared) {
          best = other;
          on = t;
        }
    if (on == from)
      break;
  }
  const auto& [a, b, c] = triangles_[on];
  const auto& w = best.weights;
  return {best.point, normalized(w[0] * normals_[a] + w[1] * normals_[b] + w[2] * normals_[c]), {}};
}

DOVETAIL_INLINE triangle_host::found triangle_host::nearest(local_id t, vec3 p) const {
  const auto& [a, b, c] = triangles_[t];
  const auto w = nearest_on_triangle(points_[a], points_[b], points_[c], p);
  const vec3 q = w[0] * points_[a] + w[1] * points_[b] + w[2] * points_[c];
  return {w, q, norm_squared(q - p)};
}

} // namespace improvement

} // namespace dovetail
