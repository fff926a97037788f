/// @file
/// How far the mesh of a region is from the surface that it is a mesh of.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace dovetail {

/// Largest distances from a surface, in units of the local size.
struct surface_deviation {
  double points = 0;  ///< of the points from where their parameters are: lines belong to two faces
  double centres = 0; ///< of the triangles' centres along the normal: what the size leaves of curvature
};

/// A report "deviation" of largest "points" and "centres", and a child with the same for each face.
inline void note_deviation(report& to, const std::string& face, const surface_deviation& found) {
  const auto raise = [&](report& noted) {
    noted.set("points", std::max(noted.get("points"), found.points));
    noted.set("centres", std::max(noted.get("centres"), found.centres));
  };
  to.name = "deviation";
  raise(to);
  auto of_face = std::find_if(to.children.begin(), to.children.end(),
                              [&](const report& child) { return child.name == face; });
  if (of_face == to.children.end()) {
    of_face = to.children.insert(of_face, report{});
    of_face->name = face;
  }
  raise(*of_face);
}

/// Adds what another such report says.
inline void merge_deviations(report& to, const report& from) {
  for (const report& face : from.children)
    note_deviation(to, face.name, {face.get("points"), face.get("centres")});
}

/// Measures the mesh of a region, which must have its parameters; one evaluation of the surface per point and
/// triangle.
inline surface_deviation measure_deviation(const any_surface& surface, const patch_boundary& boundary,
                                           const patch_mesh& made, const any_sizing& size) {
  const std::size_t frozen = boundary.points.size();
  const auto uv_of = [&](std::size_t v) { return v < frozen ? boundary.uv[v] : made.inner_uv[v - frozen]; };
  const auto point_of = [&](std::size_t v) {
    return v < frozen ? boundary.points[v] : made.inner_points[v - frozen];
  };
  surface_deviation largest;
  for (std::size_t v = 0; v < frozen + made.inner_points.size(); ++v) {
    const vec3 p = point_of(v);
    if (const double off = distance(p, surface.frame(uv_of(v)).point); off > 0)
      largest.points = std::max(largest.points, off / size(p));
  }
  for (const simplex<2>& t : made.triangles) {
    vec2 uv;
    vec3 centre;
    for (const local_id v : t) {
      uv = uv + (1.0 / 3) * uv_of(static_cast<std::size_t>(v));
      centre += (1.0 / 3) * point_of(static_cast<std::size_t>(v));
    }
    const surface_frame below = surface.frame(uv);
    const vec3 normal = normalized(cross(below.du, below.dv));
    const vec3 off = centre - below.point;
    const double height = norm_squared(normal) > 0 ? std::abs(dot(off, normal)) : norm(off);
    largest.centres = std::max(largest.centres, height / size(centre));
  }
  return largest;
}

} // namespace dovetail
