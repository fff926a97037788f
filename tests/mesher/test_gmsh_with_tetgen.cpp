#include "dovetail/adapters/gmsh_hxt.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "mesher/shapes.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

#ifndef __SANITIZE_ADDRESS__ // its runtime forbids what keeps the two apart
TEST_CASE("HXT and TetGen work in one program, though Gmsh exports a TetGen of its own") {
  const mesher_input<3> input{shapes::sphere(2), 0};
  const any_sizing size = [](vec3) { return 0.25; };
  const auto of_tetgen = mesher::tetgen{}(input, size).mesh;
  const auto of_hxt = mesher::gmsh_hxt{}(input, size).mesh;
  CHECK(of_hxt.elements != of_tetgen.elements);
  CHECK(mesher::tetgen{}(input, size).mesh.elements == of_tetgen.elements);
}
#endif
