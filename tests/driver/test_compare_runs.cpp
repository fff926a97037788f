#include "compare_runs.hpp"
#include "policies.hpp"
#include "sizes_for_elements.hpp"

#include "concepts/archetypes.hpp"

#include "dovetail/improver/any_improver.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/mesher/native_surface.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>

namespace dovetail::app {

// In place of the pipeline: what a combination does is in the name of its partitioner or mesher.

namespace {
int backgrounds_made = 0;
} // namespace

template <>
background_result<3> make_background_mesh(const any_geometry&, const any_sizing&,
                                          const policies_of<3>& policies, const generate_options&) {
  ++backgrounds_made;
  if (policies.mesher.name() == "without background")
    throw geometry_error("no surface");
  background_result<3> made;
  made.plan.subdomains = 3;
  return made;
}

template <>
generate_result generate_mesh_from(const background_result<3>& background, const any_geometry&,
                                   const policies_of<3>& policies, const generate_options&) {
  const std::string& name = policies.partitioner.name();
  if (name == "failing")
    throw partition_error("part 2 is empty");
  if (name == "stopped")
    throw cancelled();
  generate_result result;
  result.mesh.counts = {{0, 10, 100}, {0, 10, 200}};
  if (name == "incomplete") {
    result.failures.emplace_back();
    result.failures.back().subdomain = 1;
    result.failures.back().reasons = {"too thin", "still too thin"};
  }
  result.quality.elements = 300;
  result.coarse_angles.interface_faces = policies.simplifier.name() == "none" ? 10 : 12;
  result.coarse_angles.face_angle.angle_deg = 31;
  result.coarse_angles.violations.resize(policies.simplifier.name() == "none" ? 4 : 0);
  report meshing;
  meshing.name = "meshing";
  meshing.seconds = 3;
  meshing.set("mesher_seconds", 4);
  meshing.set("improver_seconds", 2);
  report coarse{"background", 1, {}, {}, {}};
  coarse.children = {{"meshing", 99, {}, {}, {}}}; // of the background mesh
  result.summary.children = {coarse, meshing};
  result.summary.seconds = background.plan.subdomains;
  return result;
}

std::function<mesh_plan(double)> plans_of(int dimension, double size) {
  return [dimension, size](double factor) {
    mesh_plan plan;
    plan.predicted_elements = 500 / std::pow(factor * size, dimension);
    return plan;
  };
}

template <>
std::function<mesh_plan(double)> plan_multiples_of(const any_geometry&, const any_sizing& size,
                                                   const policies_of<3>&, const generate_options&) {
  return plans_of(3, size({}));
}

/// Of dimension 2 there is only a plan.
template <>
std::function<mesh_plan(double)> plan_multiples_of(const any_geometry&, const any_sizing& size,
                                                   const policies_of<2>&, const generate_options&) {
  return plans_of(2, size({}));
}
template <>
background_result<2> make_background_mesh(const any_geometry&, const any_sizing&, const policies_of<2>&,
                                          const generate_options&) {
  return {};
}
template <>
generated<2> generate_mesh_from(const background_result<2>&, const any_geometry&, const policies_of<2>&,
                                const generate_options&) {
  generated<2> result;
  result.coarse_angles.interface_faces = 7;
  result.coarse_angles.surface_dihedral.angle_deg = 51;
  return result;
}

std::vector<std::string> partitioner_names() {
  return {"first", "second"};
}
template <>
std::vector<std::string> mesher_names<3>() {
  return {"only"};
}
template <>
std::vector<std::string> mesher_names<2>() {
  return {"flat"};
}
std::vector<std::string> improver_names() {
  return {"good", "none"};
}

namespace {

/// Enough of a model: nothing here looks at it.
struct nowhere {
  geometry_topology parts;
  const geometry_topology& topology() const { return parts; }
  vec3 curve_point(local_id, double) const { return {}; }
  dovetail::curve_frame curve_frame(local_id, double) const { return {}; }
  vec2 curve_uv(local_id, int, double) const { return {}; }
  vec3 face_point(local_id, vec2) const { return {}; }
  surface_frame face_frame(local_id, vec2) const { return {}; }
  double face_curvature(local_id, vec2) const { return 0; }
  vec2 project_to_face(local_id, vec3, vec2) const { return {}; }
  double project_to_curve(local_id, vec3, double) const { return 0; }
  box3 bounds() const { return {{0, 0, 0}, {1, 1, 1}}; }
  bool thread_safe() const { return true; }
};

model_source model() {
  return {"nowhere", any_geometry(nowhere{}), [](vec3) { return 0.5; }, {}};
}

/// Does nothing, to either kind of elements.
struct idle_improver {
  static constexpr improver_traits traits{};

  template <int D>
  report operator()(simplicial_mesh<D>&, const frozen_entities<D>&, const any_sizing&) const {
    return {};
  }
};

template <int D, class Mesher>
policies_of<D> policies_with(const Mesher& mesher, const combination& names) {
  return {any_mesher<D>(mesher, names.mesher),
          any_partitioner(archetype::partitioner(0), names.partitioner),
          any_improver<D>(idle_improver{}, names.improver),
          any_executor(parallel::serial{}, "serial"),
          {},
          any_simplification_rule(simplifier::paper{}, names.simplifier)};
}

policies_of<3> policies_named(const combination& names) {
  return policies_with<3>(archetype::mesher(0), names);
}

comparison_row run(const combination& names, background_store<3>& backgrounds, int* observed = nullptr) {
  return run_combination<3>(model(), names, policies_named(names), {}, backgrounds,
                            [&](const comparison_row&, const generate_result&) {
                              if (observed != nullptr)
                                ++*observed;
                            });
}

TEST_CASE("every combination is run once; no names are the defaults") {
  compare_options options;
  options.partitioners = {"a", "b", "a"};
  options.improvers = {"x", "y"};
  const auto all = combinations_of(options);
  REQUIRE(all.size() == 8);
  CHECK(all[0] == combination{"a", "only", "x", "paper"});
  CHECK(all[1] == combination{"a", "only", "x", "none"});
  CHECK(all[7] == combination{"b", "only", "y", "none"});
  options.simplifiers = {"shape", "none", "shape"};
  REQUIRE(combinations_of(options).size() == 8);
  CHECK(combinations_of(options)[0] == combination{"a", "only", "x", "shape"});
  options.simplifiers.clear();
  const auto defaults = combinations_of({});
  REQUIRE(defaults.size() == 2);
  CHECK(defaults[0] == combination{"first", "only", "good", "paper"});
  options.dimension = 2;
  CHECK(combinations_of(options).front() == combination{"a", "flat", "x", "paper"});
}

TEST_CASE("a row has the figures of its run") {
  background_store<3> backgrounds;
  int observed = 0;
  const auto with = run({"first", "only", "good", "paper"}, backgrounds, &observed);
  const auto without = run({"first", "only", "good", "none"}, backgrounds, &observed);
  CHECK(observed == 2);
  CHECK_FALSE(with.failed());
  CHECK(with.elements == 300);
  CHECK(with.imbalance == doctest::Approx(200.0 / 150));
  CHECK(with.coarse.faces == 12);
  CHECK(without.coarse.faces == 10);
  CHECK(without.coarse.under_threshold == 4);
  CHECK(with.coarse.min_face_angle == 31);
  CHECK(std::isnan(with.fine.min_face_angle));
  CHECK(with.seconds.meshing == doctest::Approx(2));
  CHECK(with.seconds.improvement == doctest::Approx(1));
  CHECK(with.seconds.total == 3);
}

TEST_CASE("a combination that fails is a row that names the kind of error, and the next one is run") {
  background_store<3> backgrounds;
  int observed = 0;
  CHECK(run({"failing", "only", "good", "paper"}, backgrounds, &observed).error ==
        "partition_error: part 2 is empty");
  const auto incomplete = run({"incomplete", "only", "good", "paper"}, backgrounds, &observed);
  CHECK(incomplete.error == "mesher_error: 1 subdomains could not be meshed; subdomain 1: "
                            "attempt 1: too thin; attempt 2: still too thin");
  CHECK(observed == 0);
  CHECK_FALSE(run({"first", "only", "good", "paper"}, backgrounds, &observed).failed());
}

TEST_CASE("a request to stop is no failure of a combination") {
  background_store<3> backgrounds;
  CHECK_THROWS_AS(run({"stopped", "only", "good", "paper"}, backgrounds), cancelled);
}

TEST_CASE("the background mesh is made once for each mesher, also when that fails") {
  background_store<3> backgrounds;
  backgrounds_made = 0;
  CHECK_FALSE(run({"first", "only", "good", "paper"}, backgrounds).background_reused);
  CHECK(run({"second", "only", "none", "none"}, backgrounds).background_reused);
  CHECK(backgrounds_made == 1);
  CHECK_FALSE(run({"first", "other", "good", "paper"}, backgrounds).background_reused);
  CHECK(backgrounds_made == 2);
  for (int k = 0; k < 2; ++k)
    CHECK(run({"first", "without background", "good", "paper"}, backgrounds).error ==
          "geometry_error: no surface");
  CHECK(backgrounds_made == 3);
}

TEST_CASE("sizes are scaled to the number of elements asked for") {
  const size_scale scale =
      scale_for_elements(model(), 32'000, policies_named({"first", "only", "good", "paper"}), {});
  CHECK(scale.predicted_elements == doctest::Approx(32'000));
  CHECK(scaled_sizes(model(), scale.factor)({}) == doctest::Approx(0.25)); // 500 / 0.25^3 = 32000
  model_source scaled_source = model();
  model_options wanted;
  wanted.elements = 32'000;
  scale_to_elements(scaled_source, wanted, policies_named({"first", "only", "good", "paper"}), {});
  CHECK(scaled_source.size({}) == doctest::Approx(0.25));
  CHECK(scaled_source.summary.warnings.empty());
  model_source same = model();
  scale_to_elements(same, {}, policies_named({"first", "only", "good", "paper"}), {});
  CHECK(same.size({}) == model().size({}));
}

policies_of<2> surface_policies() {
  return policies_with<2>(mesher::native_surface{}, {"first", "flat", "good", "paper"});
}

TEST_CASE("of dimension 2: interfaces have no angles of their own, and elements go with the size's square") {
  background_store<2> backgrounds;
  const auto row = run_combination<2>(model(), {"first", "flat", "good", "paper"}, surface_policies(), {},
                                      backgrounds, [](const comparison_row&, const generated<2>&) {});
  CHECK_FALSE(row.failed());
  CHECK(row.coarse.faces == 7);
  CHECK(row.coarse.min_dihedral == 51);
  CHECK(std::isnan(row.coarse.min_face_angle));
  const size_scale scale = scale_for_elements(model(), 8000, surface_policies(), {});
  CHECK(scaled_sizes(model(), scale.factor)({}) == doctest::Approx(0.25)); // 500 / 0.25^2 = 8000
}

} // namespace
} // namespace dovetail::app
