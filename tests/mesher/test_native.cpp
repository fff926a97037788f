#include "dovetail/mesher/native.hpp"
#include "mesher/mesher_contract.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

TEST_CASE("the native mesher keeps the boundary and fills every shape") {
  contract::check_shapes(mesher::native{});
}

TEST_CASE("the native mesher's mean edge is the size asked for") {
  contract::check_calibration(mesher::native{});
}

TEST_CASE("the native mesher follows a graded field") {
  contract::check_grading(mesher::native{});
}

TEST_CASE("the native mesher is as its traits say: non-manifold boundaries, threads, history") {
  contract::check_non_manifold(mesher::native{});
  contract::check_threads_and_history(mesher::native{});
}

TEST_CASE("the native mesher's failures are typed") {
  contract::check_errors(mesher::native{});
  contract::check_self_intersection(mesher::native{});
}

TEST_CASE("the size scale multiplies the field") {
  const mesher_input<3> input{shapes::cube(12), 0};
  CHECK(mesher::native{.size_scale = 2}(input, [](vec3) { return 0.05; }).mesh.elements ==
        mesher::native{}(input, [](vec3) { return 0.1; }).mesh.elements);
}

TEST_CASE("two boundary points at one place are named") {
  auto boundary = shapes::cube(2);
  shapes::append(boundary, shapes::cube(2, 1, {1, 0, 0}));
  CHECK_THROWS_WITH_AS((mesher::native{}(mesher_input<3>{boundary, 0}, [](vec3) { return 0.5; })),
                       doctest::Contains("make them one"), mesher_error);
}
