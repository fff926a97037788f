/// @file
/// The library's own tetrahedral mesh improver.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/global_smoothing.hpp"
#include "dovetail/improver/mesh_exchange.hpp"
#include "dovetail/improver/schedule.hpp"
#include "dovetail/improver/surface_improver.hpp"
#include "dovetail/improver/surface_limits.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace dovetail {

namespace improvement {

/// What is raised: see shape_measure.hpp.
enum class objective { minimum_dihedral, radius_ratio, mean_ratio };

/// Improves a mesh of tetrahedra by flips and moves of free vertices, worst elements first to be dealt with
/// and good ones left alone. Models `improver<native, 3>`. Start from a preset: `native::fast()`,
/// `native::fine()` (the same as `native{}`), `native::finest()`, `native::hard()` for small coarse meshes.
struct native {
  /// Elements with a dihedral angle under this, in degrees, are worked on.
  double target_angle = 29;
  /// Elements that are still under this get a last try with larger cavities.
  double stubborn_angle = 25;
  /// Sweeps over the poor elements at most.
  int passes = 12;
  /// Sweeps over what is then still poor, in which vertices are inserted and removed as well.
  int hard_passes = 8;
  /// Sweeps at the end over all free vertices of tetrahedra, for the mean of the elements; 0: none. See
  /// global_smoothing.hpp.
  int global_passes = 0;
  /// Two sweeps in a row that mend a smaller part of what the poor elements lack are the last ones.
  double least_gain = 0.01;
  /// Edges that an operation makes stay between these two, times the size there, or between the shortest and
  /// longest edge that were there before. Without a sizing field the size is the mean length of the edges
  /// before.
  double shortest_edge = 0.4, longest_edge = 2;
  /// Linearisations per move of a vertex.
  int search_iterations = 6;
  improvement::objective objective = improvement::objective::minimum_dihedral;
  /// Count elements by class before and after, for the report. Costs about 5 % of preset `fast`.
  bool statistics = true;

  static native fast() {
    native preset;
    preset.target_angle = 24.5;
    preset.passes = 4;
    preset.search_iterations = 3;
    return preset;
  }
  static native fine() { return {}; }
  static native finest() {
    native preset;
    preset.target_angle = 35;
    preset.passes = 40;
    preset.hard_passes = 12;
    preset.global_passes = 1;
    preset.least_gain = 0.002;
    preset.search_iterations = 12;
    return preset;
  }
  static native hard() {
    native preset = finest();
    preset.target_angle = 38;
    preset.stubborn_angle = 30;
    return preset;
  }

  /// Complexity: O(elements) once, then O(poor elements). Throws `mesh_error` when the input is not a mesh.
  /// (Templates, so that only who improves a mesh waits for its compilation.)
  template <int D>
    requires(D == 3)
  report operator()(simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen = {},
                    const any_sizing& size = {}) const {
    switch (objective) {
    case objective::radius_ratio:
      return improve<radius_ratio>(mesh, frozen, size);
    case objective::mean_ratio:
      return improve<mean_ratio>(mesh, frozen, size);
    case objective::minimum_dihedral:
      break;
    }
    return improve<minimum_dihedral>(mesh, frozen, size);
  }

  /// The same for triangles, in the plane or on a surface: see surface_improver.hpp.
  template <int D>
    requires(D == 2)
  report operator()(simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen = {},
                    const any_sizing& size = {}, const surface_host& host = {}) const {
    return improve_surface(*this, mesh, frozen, size, host);
  }

private:
  template <shape_measure Measure>
  report improve(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen, const any_sizing& size) const {
    const stopwatch total;
    report result;
    result.name = "improver";
    stopwatch clock;
    const auto lap = [&](const char* what) {
      result.set(std::string(what) + " seconds", clock.seconds());
      clock = stopwatch();
    };
    result.set("elements before", static_cast<double>(mesh.elements.size()));
    tet_complex complex = take_mesh(mesh, frozen, layout::along_curve);
    lap("adjacency");
    const std::size_t tangled = evaluate<Measure>(complex);
    lap("evaluation");
    const surface_limits surface(complex); // fixed sides stay, so it holds to the end
    if (statistics)
      count_quality(complex, surface).write_to(result, "before");
    lap("statistics before");
    if (!size || global_passes > 0)
      complex.set_sizes(present_sizes(complex));
    if (tangled == 0) {
      raise<Measure>(complex, surface, size, result);
    } else {
      const tet_complex original = complex;
      untangle<oriented_volume>(complex, surface, size);
      complex.set_tangled(evaluate<Measure>(complex) > 0);
      raise<Measure>(complex, surface, size, result);
      if (count_tangled(complex) > tangled || !has_distinct_sides(complex)) {
        complex = original;
        result.warnings.push_back("the mesh is too tangled to be improved; it was left as it was");
      }
      report_tangled(complex, tangled, result);
    }
    lap("schedule");
    if (statistics)
      count_quality(complex, surface).write_to(result, "after");
    lap("statistics after");
    give_back(complex, mesh);
    lap("give back");
    result.set("elements after", static_cast<double>(mesh.elements.size()));
    result.seconds = total.seconds();
    return result;
  }

  template <shape_measure Measure>
  void raise(tet_complex& complex, const surface_limits& surface, const any_sizing& size,
             report& result) const {
    schedule_limits limits = limits_for(size);
    auto& mender = limits.mender;
    mender.target = static_cast<float>(Measure::from_angle(target_angle));
    schedule<Measure> plan(complex, surface, limits);
    plan.run();
    // The few elements that are still really poor: wider cavities, more patience.
    mender.target = std::min(mender.target, static_cast<float>(Measure::from_angle(stubborn_angle)));
    mender.search.iterations *= 2;
    mender.insertion = {.growth = 30, .patience = 12};
    limits.hard_effort.open.share = 0.01;
    limits.hard_effort.narrow.share = 0.0005;
    plan.set_limits(limits);
    plan.run();
    if (global_passes > 0)
      smooth_globally<Measure>(complex, mender, result);
    plan.log().write_to(result);
    result.set("passes", plan.passes());
  }
  template <shape_measure Measure>
  void smooth_globally(tet_complex& complex, const mender_limits& mender, report& result) const {
    const stopwatch clock;
    const auto counts = global_smoothing<Measure>().run(
        complex, {.passes = global_passes, .target = mender.target, .band = mender.band});
    result.set("global smoothing tried", static_cast<double>(counts.tried));
    result.set("global smoothing accepted", static_cast<double>(counts.accepted));
    result.set("global smoothing seconds", clock.seconds());
  }
  schedule_limits limits_for(const any_sizing& size) const {
    schedule_limits limits;
    limits.passes = passes;
    limits.hard_passes = hard_passes;
    limits.least_gain = least_gain;
    limits.mender.search.iterations = search_iterations;
    limits.mender.band = {&size, shortest_edge, longest_edge};
    return limits;
  }

  /// Turns flat and inverted elements positive where it can.
  template <shape_measure Volume>
  void untangle(tet_complex& complex, const surface_limits& surface, const any_sizing& size) const {
    complex.set_tangled(true);
    evaluate<Volume>(complex);
    schedule_limits limits = limits_for(size);
    limits.mender.target = static_cast<float>(Volume::from_angle(2));
    limits.least_gain = 0;
    schedule<Volume>(complex, surface, limits).run();
  }
  /// No side belongs to more than two elements.
  static bool has_distinct_sides(tet_complex& complex) {
    std::vector<simplex<3>> alive;
    for (local_id e = 0; e < complex.element_slots(); ++e)
      if (complex.is_alive(e))
        alive.push_back(complex.vertices(e));
    try {
      match_sides(span_of(alive), complex.points().size());
    } catch (const mesh_error&) {
      return false;
    }
    return true;
  }
  static std::size_t count_tangled(const tet_complex& complex) {
    std::size_t count = 0;
    for (local_id e = 0; e < complex.element_slots(); ++e)
      count += complex.is_alive(e) && !is_positive(complex, e);
    return count;
  }
  static void report_tangled(const tet_complex& complex, std::size_t before, report& result) {
    const std::size_t left = count_tangled(complex);
    result.set("inverted before", static_cast<double>(before));
    result.set("inverted after", static_cast<double>(left));
    if (left > 0)
      result.warnings.push_back(std::to_string(left) + " elements are still flat or inverted");
  }

  /// Exactly.
  static bool is_positive(const tet_complex& complex, local_id e) {
    const auto& v = complex.vertices(e);
    return orient3d(complex.point(v[0]), complex.point(v[1]), complex.point(v[2]), complex.point(v[3])) > 0;
  }
  /// Sets the value of every element; the result is the number of flat and inverted ones, exactly.
  template <shape_measure Measure>
  static std::size_t evaluate(tet_complex& complex) {
    std::size_t tangled = 0;
    for (local_id e = 0; e < complex.element_slots(); ++e) {
      if (!complex.is_alive(e))
        continue;
      const auto& v = complex.vertices(e);
      const auto value = static_cast<float>(measure_of<Measure>(complex.point(v[0]), complex.point(v[1]),
                                                                complex.point(v[2]), complex.point(v[3])));
      complex.set_value(e, value);
      tangled += !is_positive(complex, e);
    }
    return tangled;
  }
};

/// Leaves the mesh as it is. Models `improver<none, D>`.
struct none {
  template <int D>
  report operator()(simplicial_mesh<D>&, const frozen_entities<D>& = {}, const any_sizing& = {}) const {
    report result;
    result.name = "improver";
    return result;
  }
};

} // namespace improvement

using native_improver = improvement::native;
using no_improver = improvement::none;

static_assert(improver<native_improver, 3> && improver<native_improver, 2>);
static_assert(improver<no_improver, 3> && improver<no_improver, 2>);

} // namespace dovetail
