#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/sources.hpp"
#include "mesher/mesher_contract.hpp"
#include "mesher/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

TEST_CASE("a source that only the field's bounds tell of is met") {
  const any_sizing size = keep_bounds(source_field(0.5, {point_source({0.21, 0.13, 0.07}, 0.02, 0.3, 0.01)}));
  for (const double scale : {1.0, 0.8}) {
    const auto made = mesher::native{.size_scale = scale}({shapes::sphere(2), 0}, size);
    const auto near = std::count_if(made.mesh.points.begin(), made.mesh.points.end(), [](vec3 p) {
      return distance(p, {0.21, 0.13, 0.07}) < 0.03;
    });
    CHECK(near > 30);
  }
}

TEST_CASE("boundary points that no triangle has stay where they are, wherever that is") {
  const auto cube = shapes::cube(1);
  const vec3 on_a_side{0.5, 0.5, 1}, inside{0.3, 0.4, 0.5}, at_a_vertex = cube.points.back(), far{9, 9, 9};
  for (const vec3 unused : {on_a_side, inside, at_a_vertex, far}) {
    simplicial_mesh<2> first = cube, last = cube;
    last.points.push_back(unused);
    first.points.insert(first.points.begin(), unused);
    for (auto& triangle : first.elements)
      for (local_id& v : triangle)
        ++v;
    for (const auto& boundary : {first, last}) {
      // part call
      const mesher_input<3> input{boundary, 4}; // triangles, and the tag of the elements
      const auto made = mesher::native{}(input, [](vec3) { return 0.3; });
      CHECK_NOTHROW(check_mesher_result(input, made.mesh));
      // end
      CHECK(made.mesh.points.size() > boundary.points.size());
      CHECK(made.summary.as<mesher_counts>().points == made.mesh.points.size());
      CHECK(made.mesh.elements.size() ==
            mesher::native{}({cube, 4}, [](vec3) { return 0.3; }).mesh.elements.size());
    }
  }
}

TEST_CASE("a vertex with very many triangles") {
  // A cone whose tip comes first.
  constexpr local_id n = 3000;
  simplicial_mesh<2> cone;
  cone.points = {{0, 0, 1}, {0, 0, 0}};
  for (local_id k = 0; k < n; ++k)
    cone.points.push_back(
        {std::cos(2 * std::numbers::pi * k / n), std::sin(2 * std::numbers::pi * k / n), 0});
  for (local_id k = 0; k < n; ++k) {
    const local_id a = 2 + k, b = 2 + (k + 1) % n;
    cone.elements.push_back({0, a, b});
    cone.elements.push_back({1, b, a});
  }
  const boundary_sides sides(cone.elements);
  REQUIRE(sides.entries().size() == cone.elements.size());
  for (std::size_t t = 0; t < cone.elements.size(); ++t) {
    const auto& [a, b, c] = cone.elements[t];
    const auto found = sides.find({b, c, a}), reverse = sides.find({b, a, c});
    REQUIRE(found);
    CHECK(sides.listed(found) == static_cast<local_id>(t));
    CHECK(reverse.entry == found.entry);
    CHECK(sides.listed(reverse) == no_id);
  }
  CHECK_FALSE(sides.find({0, 2, 4}));
  CHECK_FALSE(sides.find({0, 1, 2}));
  CHECK_FALSE(sides.find({2, 3, 4}));
  const mesher_input<3> input{cone, 0};
  CHECK_NOTHROW(check_mesher_result(input, mesher::native{}(input, [](vec3) { return 10.0; }).mesh));
}

TEST_CASE("two boundary points at one place are named") {
  auto boundary = shapes::cube(2);
  shapes::append(boundary, shapes::cube(2, 1, {1, 0, 0}));
  CHECK_THROWS_WITH_AS((mesher::native{}(mesher_input<3>{boundary, 0}, [](vec3) { return 0.5; })),
                       doctest::Contains("make them one"), mesher_error);
}
