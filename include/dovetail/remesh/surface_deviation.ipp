/// @file
/// What `surface_deviation.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace dovetail {

DOVETAIL_INLINE void note_deviation(report& to, const std::string& face, const surface_deviation& found) {
  const auto raise = [&](report& noted) {
    const surface_deviation before = deviation_in(noted);
    noted.set(surface_deviation{.points = std::max(before.points, found.points),
                                .centres = std::max(before.centres, found.centres),
                                .cut_off = std::max(before.cut_off, found.cut_off),
                                .gap = before.gap + found.gap});
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

DOVETAIL_INLINE void merge_deviations(report& to, const report& from) {
  for (const report& face : from.children)
    note_deviation(to, face.name, deviation_in(face));
}

DOVETAIL_INLINE void warn_of_deviations(report& to, const report& deviation) {
  constexpr std::size_t named = 5;
  std::size_t cut = 0, far = 0;
  for (const report& face : deviation.children) {
    const surface_deviation found = deviation_in(face);
    const auto away = [&](double distance) {
      return "the mesh is as far as " + number_text(distance, 2) + " of its local size from " + face.name;
    };
    if (found.cut_off > 0) {
      if (cut++ < named)
        to.warnings.push_back(away(found.cut_off) +
                              ": it cuts off an edge inside that face, or a rounding far smaller than its "
                              "elements; give smaller sizes there, or divide the face along the edge");
    } else if (found.centres > far_distance && far++ < named) {
      to.warnings.push_back(away(found.centres) + ", which no size explains; look at the mesh there");
    }
  }
  if (cut > named || far > named)
    to.warnings.push_back("so are the meshes of " +
                          std::to_string(std::max(cut, named) - named + std::max(far, named) - named) +
                          " other faces");
}

namespace detail {

/// Does the surface turn by an angle as of an edge in a small part of the way from a to b? The part is found
/// by halving where it turns more.
inline bool turns_at_once(const any_surface& surface, vec2 a, vec2 b) {
  const auto normal_at = [&](vec2 uv) {
    const surface_frame frame = surface.frame(uv);
    return normalized(cross(frame.du, frame.dv));
  };
  const double angle = turn_of_edge_deg * std::numbers::pi / 180;
  vec3 at_a = normal_at(a), at_b = normal_at(b);
  for (double share = 1; share > narrowest_turn; share *= 0.5) {
    const vec2 middle = 0.5 * (a + b);
    const vec3 at_middle = normal_at(middle);
    const double before = angle_between(at_a, at_middle), behind = angle_between(at_middle, at_b);
    if (!(std::max(before, behind) > angle))
      return false;
    (before > behind ? b : a) = middle;
    (before > behind ? at_b : at_a) = at_middle;
  }
  return true;
}

inline bool steps_over_edge(const any_surface& surface, const std::array<vec2, 3>& uv) {
  const vec2 centre = (1.0 / 3) * (uv[0] + uv[1] + uv[2]);
  for (std::size_t i = 0; i < 3; ++i) // ways from beside the corners, which may lie on edges that are kept
    if (turns_at_once(surface, uv[i] + 0.02 * (centre - uv[i]), centre))
      return true;
  return false;
}

} // namespace detail

DOVETAIL_INLINE surface_deviation measure_deviation(const any_surface& surface,
                                                    const patch_boundary& boundary, const patch_mesh& made,
                                                    const any_sizing& size) {
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
  if (surface.plane)
    return largest;
  for (const simplex<2>& t : made.triangles) {
    std::array<vec2, 3> uv;
    std::array<vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      uv[i] = uv_of(static_cast<std::size_t>(t[i]));
      corners[i] = point_of(static_cast<std::size_t>(t[i]));
    }
    const vec3 centre = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
    const surface_frame below = surface.frame((1.0 / 3) * (uv[0] + uv[1] + uv[2]));
    const vec3 normal = normalized(cross(below.du, below.dv));
    const vec3 off = centre - below.point;
    const double height = norm_squared(normal) > 0 ? std::abs(dot(off, normal)) : norm(off);
    const double distance = height / size(centre);
    largest.centres = std::max(largest.centres, distance);
    largest.gap += 0.5 * norm(cross(corners[1] - corners[0], corners[2] - corners[0])) * height;
    if (distance > noticed_distance && distance > largest.cut_off && detail::steps_over_edge(surface, uv))
      largest.cut_off = distance;
  }
  return largest;
}

} // namespace dovetail
