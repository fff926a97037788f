/// @file
/// What `fine_angles.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/decomposition/forced_angles.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/fine_angles.hpp"
#include "dovetail/pipeline/realize.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE std::vector<std::uint32_t> half_edges_that_matter(const realized<3>& skeleton) {
  const auto& first = skeleton.patches.first_triangle;
  const std::size_t regions = skeleton.coarse.regions.size();
  const std::span<const simplex<2>> sides = span_of(skeleton.fine.sides);
  const local_id line_points = skeleton.patches.line_points;
  std::vector<std::uint32_t> matter;
  for (std::size_t p = 0; p + 1 < first.size(); ++p) {
    const bool all = p >= regions && skeleton.coarse.faces[p - regions].is_curved;
    for (local_id t = first[p]; t < first[p + 1]; ++t) {
      const auto is_inside = [&](std::size_t k) { return sides[t][k] >= line_points ? 1 : 0; };
      if (!all && is_inside(0) + is_inside(1) + is_inside(2) > 1)
        continue; // as most are
      for (std::size_t k = 0; k < 3; ++k) {
        const auto ends = pick(sides[t], numbering::sides<2>[k]);
        if (all || std::max(ends[0], ends[1]) < line_points)
          matter.push_back(static_cast<std::uint32_t>(3 * static_cast<std::size_t>(t) + k));
      }
    }
  }
  return matter;
}

DOVETAIL_INLINE interface_angles fine_interface_angles(const realized<3>& skeleton,
                                                       const simplicial_background<3>&,
                                                       const divided_background<3>& divided,
                                                       const any_sizing& size, const wanted_angles& wanted,
                                                       const any_executor& run, const progress& on_progress) {
  constexpr std::size_t triangles_per_task = 200'000; // some 0.1 s
  const auto& first = skeleton.patches.first_triangle;
  const fine_skeleton& fine = skeleton.fine;
  std::vector<std::uint8_t> refused(fine.sides.size(), 0);
  for (std::size_t f = 0; f < skeleton.coarse.faces.size(); ++f)
    if (const local_id side = skeleton.coarse.faces[f].side;
        divided.side_states[side] == side_state::refused) {
      const std::size_t patch = skeleton.coarse.regions.size() + f;
      std::fill(refused.begin() + first[patch], refused.begin() + first[patch + 1], 1);
    }
  const std::size_t tasks = 1 + fine.sides.size() / triangles_per_task;
  const auto matter = half_edges_of_shares(fine, half_edges_that_matter(skeleton), tasks);
  const auto shares = values_of(map_tasks(
                                    run, tasks,
                                    [&](std::size_t task) {
                                      return measure_skeleton_angles(fine, wanted, refused, matter[task],
                                                                     mesh_state::valid, {task, tasks});
                                    },
                                    run_options{.on_progress = on_progress, .stage = "intersection"}),
                                "the measuring of interface angles");
  return once(run, [&] {
    auto angles = joined_shares(shares);
    find_forced(angles, fine.sides, cad_of(fine), size, wanted);
    return angles;
  });
}

DOVETAIL_INLINE interface_angles fine_interface_angles(const realized<2>& skeleton,
                                                       const simplicial_background<2>& mesh,
                                                       const divided_background<2>& divided,
                                                       const any_sizing&, const wanted_angles& wanted,
                                                       const any_executor& run, const progress&) {
  const auto leaves = [&](local_id side, local_id vertex) {
    const auto& ends = divided.sides.vertices[side];
    const local_id line = find_line(skeleton.lines.keys, ends[0], ends[1]);
    const auto along = skeleton.lines.along(line, vertex);
    const auto& points = skeleton.lines.points;
    return points[along[1]] - points[along[0]];
  };
  auto angles = once(run, [&] {
    return measure_interface_angles<2>({mesh.surface.mesh, divided.sides, divided.side_states,
                                        skeleton.subdomain_of_element, leaves, mesh_state::valid},
                                       wanted);
  });
  const auto& fine = skeleton.fine;
  angles.interface_faces = 0;
  for (std::size_t e = 0; e < fine.sides.size(); ++e)
    if (fine.side_hosts[e] == no_id && fine.subdomains[e][1] != no_id)
      ++angles.interface_faces;
  return angles;
}

DOVETAIL_INLINE places_of_angles places_of_small_angles(const realized<3>& skeleton,
                                                        const interface_angles& angles) {
  const auto& first = skeleton.patches.first_triangle;
  const auto regions = static_cast<std::ptrdiff_t>(skeleton.coarse.regions.size());
  places_of_angles places;
  for (const angle_violation& v : angles.violations)
    if (v.cause != violation_cause::forced) {
      places.emplace_back();
      for (const local_id triangle : v.sides)
        if (const auto face =
                std::upper_bound(first.begin(), first.end(), triangle) - first.begin() - 1 - regions;
            face >= 0)
          places.back().push_back(skeleton.coarse.faces[face].side);
      sort_unique(places.back());
    }
  sort_unique(places); // along a line each of its edges has one
  return places;
}

} // namespace dovetail::detail
