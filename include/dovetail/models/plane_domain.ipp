/// @file
/// What `plane_domain.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/plane/polylines.hpp"
#include "dovetail/models/plane_domain.hpp"

#include <cstddef>
#include <utility>

namespace dovetail {

DOVETAIL_INLINE plane_domain::plane_domain(const plane_drawing& drawing, double corner_deg) {
  check_drawing(drawing);
  plane_polylines parts = divide_at_corners(drawing, corner_deg);
  curves_ = std::move(parts.curves);
  topology_ = make_plane_topology(drawing, parts, curves_);
  for (const plane_path& polygon : drawing.polygons)
    for (const vec2 p : polygon.points)
      bounds_.include({p.x, p.y, 0});
}

DOVETAIL_INLINE vec3 plane_domain::curve_point(local_id c, double t) const {
  return in_space(curve(c).at(t));
}

DOVETAIL_INLINE dovetail::curve_frame plane_domain::curve_frame(local_id c, double t) const {
  return {in_space(curve(c).at(t)), in_space(curve(c).direction(t))};
}

DOVETAIL_INLINE vec2 plane_domain::curve_uv(local_id f, int k, double t) const {
  const auto& face = topology_.faces[f];
  return curve(face.coedges[k].curve).at(t);
}

DOVETAIL_INLINE double plane_domain::project_to_curve(local_id c, vec3 p, double seed) const {
  return curve(c).nearest({p.x, p.y}, seed);
}

#ifdef DOVETAIL_COMPILED
template any_geometry::any_geometry(plane_domain);
#endif

} // namespace dovetail
