/// @file
/// Improves a meshed piece inside its frozen boundary: tetrahedra, or triangles that stay on their surfaces.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/improve_on_host.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/unused_points.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/surface_checks.hpp"
#include "dovetail/remesh/chords.hpp"

#include <algorithm>
#include <array>
#include <iterator>
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
template <improver<3> Improver>
report improve_piece(mesher_result<3>& made, const mesher_input<3>& input, const Improver& improve,
                     const any_sizing& size) {
  frozen_entities<3> frozen;
  frozen.points = static_cast<local_id>(input.boundary.points.size());
  frozen.sides = input.boundary.elements;
  return improve(made.mesh, frozen, size);
}

/// Inner sides between points of the lines that another region might have too: their ends and their face.
inline std::vector<std::array<local_id, 3>> forbidden_chords(const simplicial_mesh<2>& mesh,
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

/// Freezes the sides of all triangles at the ends of the chords: then no such chord can be made.
inline void freeze_around(const std::vector<std::array<local_id, 3>>& chords, const simplicial_mesh<2>& mesh,
                          frozen_entities<2>& frozen) {
  std::vector<bool> is_end(mesh.points.size(), false);
  for (const auto& [a, b, face] : chords)
    is_end[static_cast<std::size_t>(a)] = is_end[static_cast<std::size_t>(b)] = true;
  for (const simplex<2>& t : mesh.elements)
    if (std::any_of(t.begin(), t.end(), [&](local_id v) { return is_end[static_cast<std::size_t>(v)]; }))
      for (std::size_t k = 0; k < 3; ++k)
        frozen.sides.push_back(sorted_vertices(simplex<1>{t[k], t[(k + 1) % 3]}));
  std::sort(frozen.sides.begin(), frozen.sides.end());
  frozen.sides.erase(std::unique(frozen.sides.begin(), frozen.sides.end()), frozen.sides.end());
}

/// Improves the triangles by `improve(mesh, frozen)`, again with more frozen where that made chords that
/// another region might have; such a side or triangle would be in the mesh twice.
template <class Improve>
report improve_without_chords(simplicial_mesh<2>& mesh, const mesher_input<2>& input,
                              frozen_entities<2>& frozen, const Improve& improve) {
  constexpr int most_attempts = 4;
  const auto as_meshed = forbidden_chords(mesh, input); // of a face's other regions in this piece
  for (int attempt = 1;; ++attempt) {
    simplicial_mesh<2> improved = mesh;
    report result = improve(improved, frozen);
    check_entries(input, improved);
    const auto found = forbidden_chords(improved, input);
    std::vector<std::array<local_id, 3>> chords;
    std::set_difference(found.begin(), found.end(), as_meshed.begin(), as_meshed.end(),
                        std::back_inserter(chords));
    if (chords.empty())
      mesh = std::move(improved);
    else if (attempt < most_attempts) {
      freeze_around(chords, mesh, frozen);
      continue;
    } else
      result.warnings.push_back("a piece stays as meshed: improved, it would touch a neighbour");
    return result;
  }
}

/// Improves triangles inside their frozen lines.
template <improver<2> Improver>
report improve_piece(mesher_result<2>& made, const mesher_input<2>& input, const Improver& improve,
                     const any_sizing& size) {
  frozen_entities<2> frozen;
  frozen.points = static_cast<local_id>(input.boundary.points.size());
  frozen.sides = input.boundary.elements;
  const auto at_poles = sides_at_poles(made.mesh, poles_of(input, made.mesh.points.size()));
  append(frozen.sides, at_poles);
  const std::size_t of_lines = input.boundary.points.size();
  const surface_host host = host_of_piece(input, std::move(made.corner_uv));
  report result = improve_without_chords(made.mesh, input, frozen,
                                         [&](simplicial_mesh<2>& mesh, const frozen_entities<2>& kept) {
                                           return improve_on_host(improve, mesh, kept, size, host);
                                         });
  drop_unused_points(made.mesh, of_lines); // an improver leaves gaps before points that it may not renumber
  return result;
}

} // namespace dovetail::detail
