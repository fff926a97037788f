/// @file
/// Improves meshes of tetrahedra.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/improver/laps.hpp"
#include "dovetail/improver/native_parameters.hpp"
#include "dovetail/improver/schedule.hpp"
#include "dovetail/improver/tetrahedra/global_smoothing.hpp"
#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "dovetail/improver/tetrahedra/poor_tetrahedra.hpp"

#include <algorithm>

namespace dovetail::improvement {

namespace detail {

/// Exactly.
inline bool is_positive(const tet_complex& complex, local_id e) {
  const auto& v = complex.vertices(e);
  return orient3d(complex.point(v[0]), complex.point(v[1]), complex.point(v[2]), complex.point(v[3])) > 0;
}
std::size_t count_tangled(const tet_complex& complex);
/// No side belongs to more than two elements.
bool has_distinct_sides(const tet_complex& complex);
void report_tangled(const tet_complex& complex, std::size_t before, report& result);

} // namespace detail

/// Sets the value of every element; the result is the number of flat and inverted ones, exactly.
template <shape_measure Measure>
std::size_t evaluate(tet_complex& complex) {
  std::size_t tangled = 0;
  for (local_id e = 0; e < complex.element_slots(); ++e) {
    if (!complex.is_alive(e))
      continue;
    const auto& v = complex.vertices(e);
    const auto value = static_cast<float>(measure_of<Measure>(complex.point(v[0]), complex.point(v[1]),
                                                              complex.point(v[2]), complex.point(v[3])));
    complex.set_value(e, value);
    tangled += !detail::is_positive(complex, e);
  }
  return tangled;
}

/// The steps of the native improver on tetrahedra.
template <class Operations, shape_measure Measure>
class tet_improver {
public:
  /// All must outlive the improver. `surface` says which elements the fixed sides of `mesh` limit.
  tet_improver(const native& parameters, tet_complex& mesh, const surface_limits& surface,
               const any_sizing& size)
      : parameters_(parameters), mesh_(mesh), surface_(surface), size_(size) {}

  /// Raises the poor elements to the target, then the worst ones once more, and then the bad ones.
  void raise(report& result) const {
    auto limits = limits_for(Measure::from_angle(parameters_.target_angle));
    poor_tetrahedra<Measure> poor(mesh_, surface_);
    schedule<poor_tetrahedra<Measure>, operations<Measure>> plan(mesh_, poor);
    plan.run(limits);
    // The few elements that are still really poor.
    auto& kept = limits.operations;
    kept.target = std::min(kept.target, static_cast<float>(Measure::from_angle(parameters_.stubborn_angle)));
    kept.search_iterations *= 2;
    kept.is_last_round = true;
    poor.hard_effort.open.share = 0.01;
    poor.hard_effort.narrow.share = 0.0005;
    plan.run(limits);
    if (parameters_.bad_angle > 0)
      plan.run(limits_for_bad(limits));
    if (parameters_.global_passes > 0)
      smooth_globally(kept, result);
    plan.log().write_to(result);
    result.set("passes", plan.passes());
  }

  /// Turns flat and inverted elements positive where it can.
  void untangle() const {
    using volume = oriented_volume;
    mesh_.set_tangled(true);
    evaluate<volume>(mesh_);
    auto limits = limits_for(volume::from_angle(2));
    limits.least_gain = 0;
    poor_tetrahedra<volume> poor(mesh_, surface_);
    schedule<poor_tetrahedra<volume>, operations<volume>>(mesh_, poor).run(limits);
  }

private:
  template <class M> // a constraint here makes clang 14 crash
  using operations = typename Operations::template on_tetrahedra<M>;

  schedule_limits<3> limits_for(double target) const {
    schedule_limits<3> limits;
    limits.passes = parameters_.passes;
    limits.hard_passes = parameters_.hard_passes;
    limits.least_gain = parameters_.least_gain;
    limits.operations.target = static_cast<float>(target);
    limits.operations.search_iterations = parameters_.search_iterations;
    limits.operations.band = {&size_, parameters_.shortest_edge, parameters_.longest_edge};
    return limits;
  }
  schedule_limits<3> limits_for_bad(schedule_limits<3> limits) const {
    constexpr double part_of_shortest = 0.25;
    auto& kept = limits.operations;
    kept.target = std::min(kept.target, static_cast<float>(Measure::from_angle(parameters_.bad_angle)));
    kept.band.shortest *= part_of_shortest;
    return limits;
  }
  void smooth_globally(const operation_limits<3>& limits, report& result) const {
    const stopwatch clock;
    const auto counts = global_smoothing<Measure>().run(
        mesh_, {.passes = parameters_.global_passes, .target = limits.target, .band = limits.band});
    result.set("global smoothing tried", static_cast<double>(counts.tried));
    result.set("global smoothing accepted", static_cast<double>(counts.accepted));
    result.set("global smoothing seconds", clock.seconds());
  }

  const native& parameters_;
  tet_complex& mesh_;
  const surface_limits& surface_;
  const any_sizing& size_;
};

/// What `native` does on tetrahedra. O(elements) once, then O(poor elements). Throws `mesh_error` when the
/// input is not a mesh.
template <class Operations, shape_measure Measure>
report improve_tetrahedra(const native& parameters, simplicial_mesh<3>& mesh,
                          const frozen_entities<3>& frozen, const any_sizing& size) {
  const stopwatch total;
  report result;
  result.name = "improver";
  laps steps(result);
  result.set("elements before", static_cast<double>(mesh.elements.size()));
  tet_complex complex = take_mesh(mesh, frozen, layout::along_curve);
  steps.end("adjacency");
  const std::size_t tangled = evaluate<Measure>(complex);
  steps.end("evaluation");
  const surface_limits surface(complex); // fixed sides stay, so it holds to the end
  if (parameters.statistics)
    count_quality(complex, surface).write_to(result, "before");
  steps.end("statistics before");
  if (!size || parameters.global_passes > 0)
    complex.set_sizes(present_sizes(complex));
  const tet_improver<Operations, Measure> improver(parameters, complex, surface, size);
  if (tangled == 0) {
    improver.raise(result);
  } else {
    const tet_complex original = complex;
    improver.untangle();
    complex.set_tangled(evaluate<Measure>(complex) > 0);
    improver.raise(result);
    if (detail::count_tangled(complex) > tangled || !detail::has_distinct_sides(complex)) {
      complex = original;
      result.warnings.push_back("the mesh is too tangled to be improved; it was left as it was");
    }
    detail::report_tangled(complex, tangled, result);
  }
  steps.end("schedule");
  if (parameters.statistics)
    count_quality(complex, surface).write_to(result, "after");
  steps.end("statistics after");
  give_back(complex, mesh);
  steps.end("give back");
  result.set("elements after", static_cast<double>(mesh.elements.size()));
  result.seconds = total.seconds();
  return result;
}

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/tetrahedra/tet_improver.ipp"
#endif
