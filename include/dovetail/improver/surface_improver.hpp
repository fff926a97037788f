/// @file
/// Improves meshes of triangles, in the plane and on surfaces.
#pragma once

#include "dovetail/improver/surface_exchange.hpp"
#include "dovetail/improver/surface_quality.hpp"
#include "dovetail/improver/surface_schedule.hpp"

#include <cmath>
#include <numbers>

namespace dovetail::improvement {

/// A triangle's smallest angle can be 60 degrees, a tetrahedron's smallest dihedral angle 70.5; yet triangles
/// are far easier: their targets are those of a preset for tetrahedra times this.
inline constexpr double triangle_target_factor = 1.25;

/// The limits that the parameters of a preset mean for triangles. `Preset` is `native`; the minimum angle is
/// the objective whatever `objective` says.
template <class Preset>
surface_schedule_limits surface_limits_of(const Preset& preset) {
  const double sine = std::sin(triangle_target_factor * preset.target_angle * std::numbers::pi / 180);
  surface_schedule_limits limits;
  limits.target = sine * sine;
  limits.relax_passes = preset.search_iterations / 2 + 1;
  limits.passes = preset.passes;
  limits.hard_passes = preset.hard_passes;
  limits.least_gain = preset.least_gain;
  limits.longest_edge = preset.longest_edge;
  return limits;
}

/// Improves triangles by flips, moves, removal and insertion of free vertices, which stay on their host.
/// The worst triangle around an operation never gets worse, and no triangle turns over. When `corner_uv` is
/// given, it receives the parameters of the result. O(n log n) once, then O(poor triangles).
template <class Preset>
report improve_surface(const Preset& preset, simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                       const any_sizing& size, const surface_host& host,
                       std::vector<std::array<vec2, 3>>* corner_uv = nullptr) {
  const stopwatch total;
  report result;
  result.name = "improver";
  stopwatch clock;
  const auto lap = [&](const char* what) {
    result.set(std::string(what) + " seconds", clock.seconds());
    clock = stopwatch();
  };
  result.set("elements before", static_cast<double>(mesh.elements.size()));
  surface_complex complex = take_surface(mesh, frozen, size, host);
  complex.shortest_edge = preset.shortest_edge;
  complex.longest_edge = preset.longest_edge;
  lap("adjacency");
  if (preset.statistics)
    count_quality(complex).write_to(result, "before");
  lap("statistics before");
  surface_schedule<surface_complex> plan(complex, surface_limits_of(preset));
  plan.run();
  plan.log().write_to(result);
  result.set("passes", plan.passes());
  lap("schedule");
  if (preset.statistics) {
    const quality_counts counts = count_quality(complex);
    counts.write_to(result, "after");
    if (const std::size_t left = counts.free.inverted + counts.limited.inverted; left > 0)
      result.warnings.push_back(std::to_string(left) + " triangles are flat or face away from their surface");
  }
  lap("statistics after");
  give_back(complex, mesh, corner_uv);
  lap("give back");
  result.set("elements after", static_cast<double>(mesh.elements.size()));
  result.seconds = total.seconds();
  return result;
}

} // namespace dovetail::improvement
