#include "dovetail/adapters/gmsh_hxt.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/parallel/serial.hpp"
#include "mesher/mesher_contract.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

TEST_CASE("HXT keeps the boundary and fills every shape") {
  contract::check_shapes(mesher::gmsh_hxt{});
}

TEST_CASE("HXT's mean edge is the size asked for") {
  contract::check_calibration(mesher::gmsh_hxt{});
}

TEST_CASE("HXT follows a graded field") {
  contract::check_grading(mesher::gmsh_hxt{});
}

TEST_CASE("HXT is as its traits say: non-manifold boundaries, threads, history") {
  contract::check_non_manifold(mesher::gmsh_hxt{});
  contract::check_threads_and_history(mesher::gmsh_hxt{});
}

TEST_CASE("HXT's failures are typed") {
  contract::check_errors(mesher::gmsh_hxt{});
  contract::check_self_intersection(mesher::gmsh_hxt{});
}

TEST_CASE("HXT's pieces do not depend on the worker that makes them") {
  const subdomain_source source = [](local_id s) {
    subdomain_input input;
    input.boundary.boundary = s % 2 == 0 ? shapes::torus(8 + s) : shapes::sphere(2 + s / 3);
    input.skeleton_points.resize(input.boundary.boundary.points.size());
    return input;
  };
  const auto run = [&](const auto& executor, std::vector<double> cost) {
    meshing_options options;
    options.predicted_cost = std::move(cost);
    const auto result = mesh_subdomains(
        6, source, mesher::gmsh_hxt{}, no_improver{}, [](vec3) { return 0.15; }, executor, options);
    CHECK(result.failures.empty());
    byte_writer bytes;
    for (local_id s = 0; s < 6; ++s)
      encode(bytes, result.load(s));
    return bytes.take();
  };
  const auto expected = run(parallel::serial{}, {});
  CHECK(run(parallel::serial{}, {1, 2, 3, 4, 5, 6}) == expected);
  CHECK(run(parallel::processes{1}, {3, 2, 6, 5, 4, 1}) == expected);
  CHECK(run(parallel::processes{3}, {}) == expected);
}
