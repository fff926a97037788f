#include "dovetail/simplification/all.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "simplification/rule_contract.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

using namespace dovetail;
using namespace dovetail_test;

TEST_CASE_TEMPLATE_DEFINE("every rule in the list keeps the contract", Rule, keeps_contract) {
  check_rule(Rule{});
}
TEST_CASE_TEMPLATE_APPLY(keeps_contract, policy_types<decltype(simplifier::all())>);

TEST_CASE("rules keep the contract with other parameters, and hidden ones") {
  SUBCASE("the paper's with shapes on the surface too") {
    check_rule(simplifier::paper{.surface_shape_deg = 20});
  }
  SUBCASE("shape only, on the surface too") {
    check_rule(simplifier::shape_only{.surface_deg = 20});
  }
  SUBCASE("by aspect ratio, on the surface too") {
    check_rule(simplifier::aspect_ratio{.surface_ratio = 0.4});
  }
  SUBCASE("along a flow that turns") {
    check_rule(simplifier::flow_aligned{.direction =
                                            [](vec3 p) {
                                              return vec3{p.y, -p.x, 0};
                                            },
                                        .surface_deg = 60});
  }
  SUBCASE("a rule that hides another") {
    check_rule(any_simplification_rule(simplifier::dihedrals_only{}));
  }
}

TEST_CASE("the names in the list differ") {
  std::vector<std::string> names;
  for_each_policy(simplifier::all(), [&](const char* name, const auto&) { names.emplace_back(name); });
  const auto count = names.size();
  sort_unique(names);
  CHECK(names.size() == count);
}

namespace {

/// A rule for triangles alone, so nothing can hide it: where it is called, it is called by name.
struct lower_side_goes {
  int* calls = nullptr;

  side_judgement operator()(const simplicial_mesh<2>&, const side_table<2>& sides) const {
    return {std::vector<double>(sides.size(), 1), 0, 50};
  }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const {
    ++*calls;
    return a.side < b.side;
  }
  double penalty(const deficit&) const { return 2; }
  std::optional<ridge_decision> propagate(const side_below&) const { return {}; }
};
static_assert(simplification_rule<lower_side_goes, 2> && !simplification_rule<lower_side_goes, 3>);
static_assert(!std::is_constructible_v<any_simplification_rule, lower_side_goes>);

} // namespace

TEST_CASE("a rule is bound at compile time down to the contraction's loop") {
  const auto mesh = squeezed_squares(12, 1);
  int calls = 0;
  const auto result = simplify<2>(mesh, mesh_duals<2>(mesh), lower_side_goes{&calls}, {.subdomains = 8});
  CHECK(calls > 50);
  check_contraction(mesh, build_sides(mesh), result);
}

namespace {

template <int D, class Rule>
simplification simplified(const simplicial_mesh<D>& mesh, const Rule& rule) {
  return simplify<D>(mesh, mesh_duals<D>(mesh), rule, {.subdomains = 8});
}

} // namespace

TEST_CASE("what interface angles a rule wants follows from its own numbers, or from the paper's") {
  const auto wants = [](const auto& rule, std::array<double, 2> faces_and_dihedrals, double corners) {
    const any_simplification_rule erased(rule);
    for (const wanted_angles& wanted : {wanted_angles_of<3>(rule), wanted_angles_of<3>(erased)})
      CHECK(std::array{wanted.face_deg, wanted.dihedral_deg} == faces_and_dihedrals);
    CHECK(wanted_angles_of<2>(rule).dihedral_deg == corners);
    CHECK(wanted_angles_of<2>(erased).dihedral_deg == corners);
  };
  wants(simplifier::paper{}, {30, 30}, 50);
  wants(simplifier::none{}, {30, 30}, 50);
  wants(simplifier::paper{.surface_dihedral_deg = 45, .volume_dihedral_deg = 20, .volume_shape_deg = 25},
        {25, 20}, 45);
  wants(simplifier::paper{.surface_dihedral_deg = 0, .volume_dihedral_deg = 0}, {30, 30}, 50);
  wants(simplifier::shape_only{.volume_deg = 35}, {35, 30}, 50);
  wants(simplifier::dihedrals_only{.surface_dihedral_deg = 40, .volume_dihedral_deg = 25}, {30, 25}, 40);
  wants(simplifier::aspect_ratio{.volume_dihedral_deg = 22}, {30, 22}, 50);
  wants(simplifier::flow_aligned{.surface_dihedral_deg = 33}, {30, 30}, 33);
}

TEST_CASE("no rule leaves every element by itself") {
  const auto result = simplified<3>(squeezed_cubes(4, 1), simplifier::none{});
  CHECK(result.summary.get("removed_sides") == 0);
  CHECK(result.summary.get("refused_sides") == 0);
  for (const double weight : result.graph.edge_weights)
    CHECK(weight == 1);
}

TEST_CASE("the paper's rule with one half switched off is the other half's") {
  const auto cubes = squeezed_cubes(4, 2, 0.6);
  const auto squares = squeezed_squares(15, 2);
  const auto same = [&](const auto& half, const simplifier::paper& other_off) {
    CHECK(simplified<3>(cubes, half).side_states == simplified<3>(cubes, other_off).side_states);
    CHECK(simplified<2>(squares, half).side_states == simplified<2>(squares, other_off).side_states);
  };
  same(simplifier::dihedrals_only{}, {.volume_shape_deg = 0});
  same(simplifier::shape_only{}, {.surface_dihedral_deg = 0, .volume_dihedral_deg = 0});
  same(simplifier::none{},
       {.surface_dihedral_deg = 0, .volume_dihedral_deg = 0, .surface_shape_deg = 0, .volume_shape_deg = 0});
}

TEST_CASE("each threshold of the paper's rule counts in its own place") {
  const auto cubes = squeezed_cubes(4, 2, 0.8);
  const auto squares = squeezed_squares(15, 2);
  const auto removed = [](const simplification& result) { return result.summary.get("removed_sides"); };
  const double in_volume = removed(simplified<3>(cubes, simplifier::paper{}));
  const double on_surface = removed(simplified<2>(squares, simplifier::paper{}));
  CHECK(removed(simplified<3>(cubes, simplifier::paper{.volume_dihedral_deg = 40})) > in_volume);
  CHECK(removed(simplified<3>(cubes, simplifier::paper{.volume_shape_deg = 40})) > in_volume);
  CHECK(removed(simplified<3>(cubes, simplifier::paper{.surface_dihedral_deg = 60})) == in_volume);
  CHECK(removed(simplified<2>(squares, simplifier::paper{.surface_dihedral_deg = 40})) < on_surface);
  CHECK(removed(simplified<2>(squares, simplifier::paper{.surface_shape_deg = 40})) > on_surface);
  CHECK(removed(simplified<2>(squares, simplifier::paper{.volume_dihedral_deg = 60})) == on_surface);
}

TEST_CASE("aspect ratios are those of known triangles") {
  const auto ratio = [](double x, double y) {
    return simplifier::aspect_ratio::ratio({vec3{0, 0, 0}, vec3{1, 0, 0}, vec3{x, y, 0}});
  };
  CHECK(ratio(0.5, std::sqrt(0.75)) == doctest::Approx(1));
  CHECK(ratio(0.5, 0.5 * std::tan(3.14159265358979 / 6)) == doctest::Approx(0.4641).epsilon(1e-4));
  CHECK(ratio(0, 1) == doctest::Approx(2 * std::sqrt(2.0) - 2));
  CHECK(ratio(0.3, 0) == 0);
}

TEST_CASE("along a flow, what crosses it goes") {
  // In a mesh of good angles only the flow tells sides apart.
  const auto mesh = jittered_squares(12, 0.05, 3);
  const auto sides = build_sides(mesh);
  const simplifier::flow_aligned rule{.direction =
                                          [](vec3) {
                                            return vec3{0, 2, 0};
                                          },
                                      .surface_deg = 60,
                                      .surface_dihedral_deg = 0};
  const auto result = simplify<2>(mesh, mesh_duals<2>(mesh, sides), rule, {.fraction = unbounded});
  CHECK(result.summary.get("removed_sides") > 50);
  CHECK(result.summary.get("kept_sides") > 50);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const vec3 along = mesh.points[sides.vertices[s][1]] - mesh.points[sides.vertices[s][0]];
    const bool crosses = std::abs(along.y) < 0.5 * norm(along); // more than 60 degrees from the y axis
    if (result.side_states[s] != side_state::fixed && crosses)
      CHECK(result.side_states[s] == side_state::removed);
    if (!crosses)
      CHECK(result.side_states[s] != side_state::refused);
  }
  const simplifier::flow_aligned still{.direction =
                                           [](vec3) {
                                             return vec3{0, 0, 0};
                                           },
                                       .surface_deg = 60,
                                       .surface_dihedral_deg = 0};
  CHECK(simplify<2>(mesh, mesh_duals<2>(mesh, sides), still).summary.get("removed_sides") == 0);
  CHECK_THROWS_AS(simplify<2>(mesh, mesh_duals<2>(mesh, sides), simplifier::flow_aligned{.direction = {}}),
                  usage_error);
}

TEST_CASE("a face along the flow is as good as can be, one across it as bad") {
  simplicial_mesh<3> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.elements = {{0, 1, 2, 3}};
  const auto sides = build_sides(mesh);
  const auto judged = simplifier::flow_aligned{.direction =
                                                   [](vec3) {
                                                     return vec3{0, 0, 3};
                                                   },
                                               .volume_deg = 70}(mesh, sides);
  CHECK(judged.wanted_quality == 20);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto& v = sides.vertices[s];
    const bool has_tip = std::find(v.begin(), v.end(), 3) != v.end();
    const bool has_origin = std::find(v.begin(), v.end(), 0) != v.end();
    const double slope = 90 - degrees_per_radian * std::asin(std::sqrt(1.0 / 3));
    CHECK(judged.quality[s] == doctest::Approx(!has_tip ? 0 : has_origin ? 90 : slope));
  }
}

TEST_CASE("sides at a removed edge are removed, those at a refused one only penalised") {
  const auto check = [](const auto& rule) {
    const auto removed = rule.propagate({side_state::removed, 0.5, {}});
    REQUIRE(removed);
    CHECK(!removed->only_penalise);
    CHECK(removed->missed.value == 0.5);
    const auto refused = rule.propagate({side_state::refused, 0.7, {0.5, 0.9}});
    REQUIRE(refused);
    CHECK(refused->only_penalise);
    CHECK(refused->missed.value == 0.5);
    CHECK(refused->missed.wanted == 0.9);
  };
  check(simplifier::paper{});
  check(simplifier::shape_only{});
  check(simplifier::dihedrals_only{});
  check(simplifier::aspect_ratio{});
  check(simplifier::flow_aligned{});
  CHECK(!simplifier::none{}.propagate({side_state::removed, 0.5, {}}));
  CHECK(simplifier::paper{}.propagate({side_state::removed, 20, {}})->missed.wanted == 50);
}

TEST_CASE("the penalty of a refused side grows with what is missing") {
  const simplifier::paper rule{.penalty_of_refusal = {3, 100}};
  CHECK(rule.penalty({30, 30}) == 4);
  CHECK(rule.penalty({40, 30}) == 4);
  CHECK(rule.penalty({15, 30}) == 54);
}

TEST_CASE("a rule that hides another gives the same") {
  const simplifier::flow_aligned rule{.surface_deg = 70, .penalty_of_refusal = {1, 2}};
  const any_simplification_rule hidden(rule, "flow");
  CHECK(hidden.name() == "flow");
  const auto cubes = squeezed_cubes(4, 1);
  const auto squares = squeezed_squares(12, 1);
  CHECK(simplified<3>(cubes, hidden).side_states == simplified<3>(cubes, rule).side_states);
  CHECK(simplified<3>(cubes, hidden).graph.edge_weights == simplified<3>(cubes, rule).graph.edge_weights);
  CHECK(simplified<2>(squares, hidden).side_states == simplified<2>(squares, rule).side_states);
  CHECK(hidden.propagate({side_state::removed, 5, {}})->missed.wanted == 90);
}

TEST_CASE("a rule that judges another number of sides is refused") {
  struct too_few : simplifier::paper {
    side_judgement operator()(const simplicial_mesh<2>&, const side_table<2>&) const { return {{1, 2}}; }
  };
  const auto mesh = squeezed_squares(3, 1);
  CHECK_THROWS_AS(simplify<2>(mesh, mesh_duals<2>(mesh), too_few{}), usage_error);
}
