#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "mesher/mesher_contract.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

/// An exception that leaves TetGen through its sizing callback leaks what TetGen holds in raw pointers: once
/// per failed piece, in a worker that is then replaced.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:tetgenmesh";
}

TEST_CASE("TetGen keeps the boundary and fills every shape") {
  contract::check_shapes(mesher::tetgen{});
}

TEST_CASE("TetGen's mean edge is the size asked for") {
  contract::check_calibration(mesher::tetgen{});
}

TEST_CASE("TetGen follows a graded field") {
  contract::check_grading(mesher::tetgen{});
}

TEST_CASE("TetGen is as its traits say: non-manifold boundaries, threads, history") {
  contract::check_non_manifold(mesher::tetgen{});
  contract::check_threads_and_history(mesher::tetgen{});
}

TEST_CASE("TetGen's failures are typed") {
  contract::check_errors(mesher::tetgen{});
  contract::check_self_intersection(mesher::tetgen{});
}

TEST_CASE("Every fallback fulfils the contract") {
  const auto meshers = with_fallbacks(mesher::tetgen{});
  REQUIRE(meshers.size() == 5);
  for (std::size_t attempt = 1; attempt < meshers.size(); ++attempt) {
    CAPTURE(attempt);
    contract::check_shapes(meshers[attempt]);
  }
}

TEST_CASE("Voids are found whether or not hole points are given") {
  auto shell = shapes::cube(6);
  shapes::append(shell, shapes::sphere(1, 0.3, {0.5, 0.5, 0.5}), true);
  const auto points = points_in_voids(shell);
  REQUIRE(points.size() == 1);
  CHECK(distance(points[0], {0.5, 0.5, 0.5}) < 0.3);
  contract::mesh_and_check(mesher::tetgen{.use_hole_points = false}, shell, [](vec3) { return 0.2; });
}

TEST_CASE("The watchdog ends a refinement that exceeds its budget") {
  const mesher_input<3> input{shapes::cube(4), 0};
  const mesher::tetgen impatient{.call_budget_factor = 0.01};
  const any_sizing fine = [](vec3) { return 0.02; };
  CHECK_THROWS_WITH_AS(impatient(input, fine), doctest::Contains("without end"), mesher_error);
  CHECK(mesher::tetgen{}(input, [](vec3) { return 0.2; }).mesh.elements.size() > 100); // still usable
}

TEST_CASE("The size scale multiplies the field") {
  const auto boundary = shapes::cube(12);
  const mesher_input<3> input{boundary, 0};
  const any_sizing size = [](vec3) { return 0.05; };
  const any_sizing doubled = [](vec3) { return 0.1; };
  CHECK(mesher::tetgen{.size_scale = 2}(input, size).mesh.elements ==
        mesher::tetgen{}(input, doubled).mesh.elements);
}
