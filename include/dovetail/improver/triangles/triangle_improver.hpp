/// @file
/// Improves meshes of triangles, in the plane and on surfaces.
#pragma once

#include "dovetail/improver/laps.hpp"
#include "dovetail/improver/native_parameters.hpp"
#include "dovetail/improver/schedule.hpp"
#include "dovetail/improver/triangles/poor_triangles.hpp"
#include "dovetail/improver/triangles/relaxation.hpp"
#include "dovetail/improver/triangles/surface_exchange.hpp"
#include "dovetail/improver/triangles/surface_quality.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace dovetail::improvement {

/// A triangle's smallest angle can be 60 degrees, a tetrahedron's smallest dihedral angle 70.5; yet triangles
/// are far easier: their targets are those of a preset for tetrahedra times this.
inline constexpr double triangle_target_factor = 1.25;
/// With a smaller share of poor triangles nothing but those is worked on.
inline constexpr double few_poor_triangles = 0.005;

namespace detail {

inline double sine_squared(double degrees) {
  const double sine = std::sin(degrees * std::numbers::pi / 180);
  return sine * sine;
}

/// Deals with the worst triangles first: when all are worked on at once, moves for the sake of the many that
/// are nearly good stand in the way of the few that are not. A mesh with few poor triangles is not relaxed,
/// which takes as long as making it.
template <class Operations>
void raise(const native& parameters, surface_complex& mesh, report& result) {
  schedule_limits<2> limits;
  limits.passes = parameters.passes;
  limits.hard_passes = parameters.hard_passes;
  limits.least_gain = parameters.least_gain;
  limits.operations.longest_edge = parameters.longest_edge;
  double& target = limits.operations.target;
  const double last = target = sine_squared(triangle_target_factor * parameters.target_angle);
  poor_triangles poor(mesh);
  schedule<poor_triangles, typename Operations::on_triangles> plan(mesh, poor);
  poor.aim(limits.operations);
  if (poor.lacking() > 0 &&
      static_cast<double>(poor.list().size()) > few_poor_triangles * mesh.table.triangle_slots())
    relaxation(mesh, plan.log()).run(parameters.search_iterations / 2 + 1);
  for (const double rung : {sine_squared(30), sine_squared(36)})
    if (rung < last) {
      target = rung;
      plan.run(limits);
    }
  target = last;
  plan.run(limits);
  plan.log().write_to(result);
  result.set("passes", plan.passes());
}

} // namespace detail

/// What `native` does on triangles: flips, moves, removal and insertion of free vertices, which stay on their
/// host. The worst triangle around an operation never gets worse, and no triangle turns over. When
/// `corner_uv` is given, it receives the parameters of the result. O(n log n) once, then O(poor triangles).
template <class Operations>
report improve_surface(const native& parameters, simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                       const any_sizing& size, const surface_host& host,
                       std::vector<std::array<vec2, 3>>* corner_uv = nullptr) {
  const stopwatch total;
  report result;
  result.name = "improver";
  laps steps(result);
  result.set("elements before", static_cast<double>(mesh.elements.size()));
  surface_complex complex = take_surface(mesh, frozen, size, host);
  complex.shortest_edge = parameters.shortest_edge;
  complex.longest_edge = parameters.longest_edge;
  steps.end("adjacency");
  if (parameters.statistics)
    count_quality(complex).write_to(result, "before");
  steps.end("statistics before");
  detail::raise<Operations>(parameters, complex, result);
  steps.end("schedule");
  if (parameters.statistics) {
    const quality_counts counts = count_quality(complex);
    counts.write_to(result, "after");
    if (const std::size_t left = counts.free.inverted + counts.limited.inverted; left > 0)
      result.warnings.push_back(std::to_string(left) + " triangles are flat or face away from their surface");
  }
  steps.end("statistics after");
  give_back(complex, mesh, corner_uv);
  steps.end("give back");
  result.set("elements after", static_cast<double>(mesh.elements.size()));
  result.seconds = total.seconds();
  return result;
}

} // namespace dovetail::improvement
