#include "dovetail/adapters/gmsh_delaunay.hpp"
#include "mesher/mesher_contract.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

TEST_CASE("Gmsh Delaunay keeps the boundary and fills every shape") {
  contract::check_shapes(mesher::gmsh_delaunay{});
}

TEST_CASE("Gmsh Delaunay's mean edge is the size asked for") {
  contract::check_calibration(mesher::gmsh_delaunay{});
}

TEST_CASE("Gmsh Delaunay follows a graded field") {
  contract::check_grading(mesher::gmsh_delaunay{});
}

TEST_CASE("Gmsh Delaunay is as its traits say: non-manifold boundaries, threads, history") {
  contract::check_non_manifold(mesher::gmsh_delaunay{});
  contract::check_threads_and_history(mesher::gmsh_delaunay{});
}

TEST_CASE("Gmsh Delaunay's failures are typed") {
  contract::check_errors(mesher::gmsh_delaunay{});
  contract::check_self_intersection(mesher::gmsh_delaunay{});
}
