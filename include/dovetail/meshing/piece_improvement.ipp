/// @file
/// What `piece_improvement.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/meshing/piece_improvement.hpp"
#include "dovetail/remesh/chords.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE surface_host host_of_piece(const mesher_input<2>& input,
                                           std::vector<std::array<vec2, 3>> corner_uv) {
  struct face {
    any_surface surface;
    bool reversed;
  };
  struct faces_of_regions {
    region_of_face find;
    std::vector<face> listed;
    const face& at(local_id id) const { return listed[find(id)]; }
  };
  auto faces = std::make_shared<faces_of_regions>(faces_of_regions{region_of_face(input.regions), {}});
  for (const surface_region& region : input.regions)
    faces->listed.push_back({region.surface, region.reversed});
  const auto point_at = [](const face& on, vec2 uv) {
    const surface_frame f = on.surface.plane ? on.surface.plane->frame(uv) : on.surface.frame(uv);
    const vec3 normal = normalized(cross(f.du, f.dv));
    return host_point{f.point, on.reversed ? -normal : normal, uv};
  };
  surface_host host;
  host.project = [faces, point_at](local_id id, vec3 p, vec2 near) {
    const face& on = faces->at(id);
    return point_at(on, on.surface.plane ? on.surface.plane->project(p) : on.surface.project(p, near));
  };
  host.evaluate = [faces, point_at](local_id id, vec2 uv) { return point_at(faces->at(id), uv); };
  host.corner_uv = std::move(corner_uv);
  host.plane_normal = [faces](local_id id) {
    const face& on = faces->at(id);
    if (!on.surface.plane)
      return vec3{};
    const vec3 normal = cross(on.surface.plane->x_axis, on.surface.plane->y_axis);
    return on.reversed ? -normal : normal;
  };
  return host;
}

DOVETAIL_INLINE std::vector<bool> poles_of(const mesher_input<2>& input, std::size_t points) {
  std::vector<bool> is_pole(points, false);
  for (const surface_region& region : input.regions)
    for (const auto& [a, b] : region.boundary.segments)
      if (const local_id label = region.boundary.labels[a]; label == region.boundary.labels[b])
        is_pole[label] = true;
  return is_pole;
}

DOVETAIL_INLINE std::vector<std::array<local_id, 3>> forbidden_chords(const simplicial_mesh<2>& mesh,
                                                                      const mesher_input<2>& input) {
  std::vector<std::array<local_id, 3>> chords;
  const chord_finder chord_of(input.boundary.points.size(), input.boundary.elements);
  chord_of.for_each(mesh.elements, [&](std::size_t t, const std::array<local_id, 2>& chord) {
    const bool is_forbidden =
        std::any_of(input.regions.begin(), input.regions.end(), [&](const surface_region& region) {
          return region.face == mesh.tags[t] && region.forbids && region.forbids(chord[0], chord[1]);
        });
    if (is_forbidden)
      chords.push_back({chord[0], chord[1], mesh.tags[t]});
  });
  std::sort(chords.begin(), chords.end());
  return chords;
}

DOVETAIL_INLINE void freeze_around(const std::vector<std::array<local_id, 3>>& chords,
                                   const simplicial_mesh<2>& mesh, frozen_entities<2>& frozen) {
  std::vector<bool> is_end(mesh.points.size(), false);
  for (const auto& [a, b, face] : chords)
    is_end[a] = is_end[b] = true;
  for (const simplex<2>& t : mesh.elements)
    if (std::any_of(t.begin(), t.end(), [&](local_id v) { return is_end[v]; }))
      for (std::size_t k = 0; k < 3; ++k)
        frozen.sides.push_back(sorted_vertices(simplex<1>{t[k], t[(k + 1) % 3]}));
  std::sort(frozen.sides.begin(), frozen.sides.end());
  frozen.sides.erase(std::unique(frozen.sides.begin(), frozen.sides.end()), frozen.sides.end());
}

} // namespace dovetail::detail
