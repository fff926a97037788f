/// @file
/// Improves a meshed piece inside its frozen boundary: tetrahedra, or triangles that stay on their surfaces.
#pragma once

#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/surface_host.hpp"
#include "dovetail/mesher/concepts.hpp"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The surfaces of a piece as the host of its triangles; it keeps what it needs of `input`.
inline surface_host host_of_piece(const mesher_input<2>& input, std::vector<std::array<vec2, 3>> corner_uv) {
  struct face {
    any_surface surface;
    bool reversed;
  };
  auto faces = std::make_shared<std::map<local_id, face>>();
  for (const surface_region& region : input.regions)
    faces->try_emplace(region.face, face{region.surface, region.reversed});
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

/// Which points of a piece are poles: ends of segments that are a point in space.
inline std::vector<bool> poles_of(const mesher_input<2>& input, std::size_t points) {
  std::vector<bool> is_pole(points, false);
  for (const surface_region& region : input.regions)
    for (const auto& [a, b] : region.boundary.segments)
      if (const local_id label = region.boundary.labels[static_cast<std::size_t>(a)];
          label == region.boundary.labels[static_cast<std::size_t>(b)])
        is_pole[static_cast<std::size_t>(label)] = true;
  return is_pole;
}

/// Improves tetrahedra inside their frozen boundary.
template <improver<3> I>
report improve_piece(mesher_result<3>& made, const mesher_input<3>& input, const I& improve,
                     const any_sizing& size) {
  frozen_entities<3> frozen;
  frozen.points = static_cast<local_id>(input.boundary.points.size());
  frozen.sides = input.boundary.elements;
  return improve(made.mesh, frozen, size);
}

/// Removes the points after the first `kept` that no element uses: an improver leaves gaps where it has
/// removed points before ones that it may not renumber.
inline void drop_unused_points(simplicial_mesh<2>& mesh, std::size_t kept) {
  std::vector<local_id> number(mesh.points.size(), no_id);
  for (const simplex<2>& t : mesh.elements)
    for (const local_id v : t)
      number[static_cast<std::size_t>(v)] = v;
  std::size_t next = kept;
  for (std::size_t v = kept; v < number.size(); ++v)
    if (number[v] != no_id) {
      mesh.points[next] = mesh.points[v];
      number[v] = static_cast<local_id>(next++);
    }
  if (next == mesh.points.size())
    return;
  mesh.points.resize(next);
  for (simplex<2>& t : mesh.elements)
    for (local_id& v : t)
      if (static_cast<std::size_t>(v) >= kept)
        v = number[static_cast<std::size_t>(v)];
}

/// Improves triangles inside their frozen lines. An improver that takes no host cannot know the surface: it
/// may move points of planes in z = 0 only.
template <improver<2> I>
report improve_piece(mesher_result<2>& made, const mesher_input<2>& input, const I& improve,
                     const any_sizing& size) {
  frozen_entities<2> frozen;
  frozen.points = static_cast<local_id>(input.boundary.points.size());
  frozen.sides = input.boundary.elements;
  const auto at_poles = sides_at_poles(made.mesh, poles_of(input, made.mesh.points.size()));
  frozen.sides.insert(frozen.sides.end(), at_poles.begin(), at_poles.end());
  constexpr bool takes_host = requires(const surface_host& host) {
    improve(made.mesh, frozen, size, host);
  };
  const std::size_t of_lines = input.boundary.points.size();
  report result;
  if constexpr (takes_host) {
    result = improve(made.mesh, frozen, size, host_of_piece(input, std::move(made.corner_uv)));
  } else {
    for (const surface_region& region : input.regions)
      if (!region.surface.plane)
        frozen.points = static_cast<local_id>(made.mesh.points.size());
    result = improve(made.mesh, frozen, size);
  }
  drop_unused_points(made.mesh, of_lines);
  return result;
}

} // namespace dovetail::detail
