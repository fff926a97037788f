#include "dovetail/pipeline/repairs.hpp"

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

constexpr int rounds = 6;

decomposition_state eight_subdomains() {
  return {{0, 1, 2, 3, 4, 5, 6, 7}, {8, 0.05}, any_sizing(uniform_size(1))};
}

geometry_topology two_faces() {
  geometry_topology topology;
  topology.faces.resize(2);
  return topology;
}

/// Two CAD faces that cross at a place.
suppression_plan crossing_faces() {
  suppression_plan plan;
  plan.surface_crossings = {{{0, 1}, {1, 2, 3}, 0.5}};
  return plan;
}

/// An interface between two subdomains that crosses something at a place.
suppression_plan crossing_interface(local_id a, local_id b) {
  suppression_plan plan;
  plan.merges = {{a, b}};
  plan.interface_crossings = {{{no_id, 0}, {1, 2, 3}, 0.5}};
  return plan;
}

std::optional<repair> repair_of(const suppression_plan& plan, const decomposition_state& state) {
  return repair_of_crossings(plan, state, two_faces(), rounds);
}

} // namespace

TEST_CASE("Where nothing crosses there is nothing to repair") {
  CHECK(!repair_of({}, eight_subdomains()));
  CHECK(!refine_faults({}, eight_subdomains()));
  CHECK(!merge_failures<3>({}, {}, eight_subdomains()));
}

TEST_CASE("CAD faces that cross get smaller triangles, as long as there are rounds") {
  auto state = eight_subdomains();
  for (int round = 0; round < rounds; ++round) {
    const auto wanted = repair_of(crossing_faces(), state);
    REQUIRE(wanted);
    REQUIRE(wanted->smaller_sizes.size() == 1);
    CHECK(wanted->smaller_sizes[0].center == vec3{1, 2, 3});
    CHECK(wanted->smaller_sizes[0].size == doctest::Approx(0.25));
    CHECK(wanted->merges.empty());
    apply(*wanted, state);
    CHECK(state.refinements == round + 1);
  }
  CHECK(state.size.everywhere()({1, 2, 3}) == doctest::Approx(0.25));
  CHECK(state.size.everywhere()({9, 9, 9}) == doctest::Approx(1));
  CHECK_THROWS_WITH_AS(repair_of(crossing_faces(), state),
                       doctest::Contains("the surfaces of face 0 and face 1 cross"), intersection_error);
}

TEST_CASE("Where smaller triangles multiply the folded ones there is no further round") {
  const auto folded = [](std::size_t times) {
    suppression_plan plan = crossing_faces();
    plan.surface_crossings.resize(times, plan.surface_crossings.front());
    plan.folds = "a region is folded over";
    return plan;
  };
  auto state = eight_subdomains();
  apply(*repair_of(folded(5), state), state);
  CHECK(state.faults == 5);
  CHECK(repair_of(folded(35), state)->smaller_sizes.size() == 35);
  CHECK(repair_of(folded(36), state)->too_many_merges == "a region is folded over");
  CHECK(refine_faults(folded(35).surface_crossings, state));
  CHECK(!refine_faults(folded(36).surface_crossings, state));
  // Crossings of faces are of another kind, before and after.
  suppression_plan crossing = folded(36);
  crossing.folds.clear();
  CHECK(repair_of(crossing, state)->smaller_sizes.size() == 36);
  apply(*repair_of(crossing, state), state);
  state.refinements = 1;
  CHECK(repair_of(folded(200), state)->smaller_sizes.size() == 200);

  auto one = decomposition_state{{0}, {1, 0.05}, any_sizing(uniform_size(1))};
  apply(*repair_of(folded(5), one), one);
  CHECK(repair_of(folded(35), one)->smaller_sizes.size() == 35);
  CHECK_THROWS_AS(repair_of(folded(36), one), intersection_error);
}

TEST_CASE("A face that stays folded over asks for fewer subdomains, where there can be fewer") {
  auto plan = crossing_faces();
  plan.folds = "a region is folded over";
  auto state = eight_subdomains();
  state.refinements = 1;
  CHECK(repair_of(plan, state)->too_many_merges.empty());
  state.refinements = 2;
  CHECK(repair_of(plan, state)->too_many_merges == plan.folds);
  CHECK(!repair_of(plan, state)->changes_anything());
  state.merges = {1, 0.05};
  CHECK(repair_of(plan, state)->too_many_merges.empty());
}

TEST_CASE("Interfaces that cross are merged, refined when that is too many, and then given up") {
  auto state = eight_subdomains();
  for (int merge = 0; merge < 2; ++merge) {
    const auto wanted = repair_of(crossing_interface(0, 1), state);
    REQUIRE(wanted);
    CHECK(wanted->merges == std::vector<std::array<local_id, 2>>{{0, 1}});
    CHECK(wanted->smaller_sizes.empty());
    apply(*wanted, state);
  }
  CHECK(state.merges.subdomains() == 6);
  CHECK(state.subdomain_of_element == std::vector<local_id>{0, 0, 0, 1, 2, 3, 4, 5});
  CHECK(state.merged_after_failure == 0);
  for (int refinement = 0; refinement < 2; ++refinement) {
    const auto wanted = repair_of(crossing_interface(0, 1), state);
    REQUIRE(wanted);
    CHECK(wanted->smaller_sizes.size() == 1);
    CHECK(wanted->merges.empty());
    apply(*wanted, state);
  }
  const auto last = repair_of(crossing_interface(0, 1), state);
  REQUIRE(last);
  CHECK(!last->changes_anything());
  CHECK(last->too_many_merges ==
        "3 of 8 subdomains would have to be merged, 2 may be: their interfaces cross the surface");
}

TEST_CASE("Lines at fault are made finer before anything is merged, and an error where no merge helps") {
  auto plan = crossing_interface(0, 1);
  plan.lines_at_fault = "two lines cross";
  auto state = eight_subdomains();
  CHECK(!repair_of(plan, state)->smaller_sizes.empty());
  state.refinements = 2;
  CHECK(!repair_of(plan, state)->merges.empty());
  plan.merges_suffice = false;
  CHECK_THROWS_WITH_AS(repair_of(plan, state), "two lines cross", mesher_error);
}

TEST_CASE("A subdomain that cannot be meshed is merged with the neighbour at its largest interface") {
  fine_skeleton skeleton;
  skeleton.points = std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}, {0, 3, 0}};
  skeleton.sides = std::vector<simplex<2>>{{0, 1, 2}, {0, 3, 4}};
  skeleton.side_hosts = std::vector<local_id>{no_id, no_id};
  skeleton.subdomains = std::vector<std::array<local_id, 2>>{{2, 3}, {3, 5}};
  auto state = eight_subdomains();
  piece_failure failure;
  failure.subdomain = 3;
  failure.reasons = {"mesher: no"};
  const auto wanted = merge_failures<3>(skeleton, {failure}, state);
  REQUIRE(wanted);
  CHECK(wanted->merges == std::vector<std::array<local_id, 2>>{{3, 5}});
  CHECK(wanted->warnings ==
        std::vector<std::string>{
            "no attempt could mesh a subdomain, merged with a neighbour: attempt 1: mesher: no"});
  apply(*wanted, state);
  CHECK(state.merged_after_failure == 1);

  state.merges = {8, 0};
  apply({.merges = {{0, 1}, {0, 2}}}, state);
  const auto refused = merge_failures<3>(skeleton, {failure}, state);
  REQUIRE(refused);
  CHECK(!refused->changes_anything());
  CHECK(refused->too_many_merges.empty()); // the failure is data
  REQUIRE(refused->warnings.size() == 1);
  CHECK(refused->warnings[0].find("would have to be merged, 2 may be") != std::string::npos);
}
