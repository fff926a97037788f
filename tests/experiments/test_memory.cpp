#include "dovetail/experiments/simulation/memory.hpp"

#include <doctest/doctest.h>

using namespace dovetail;
using namespace dovetail::simulation;

TEST_CASE("Ranks hold the background each, their workers a piece each, and a node the skeleton") {
  const rank_memory memory{1000, 100, 1, 10};
  const mesh_sizes sizes{.background_elements = 5, .skeleton_sides = 7, .largest_piece = 3};
  CHECK(memory.of_node(sizes, 1, 1) == doctest::Approx(1000 + 500 + 70 + 3));
  CHECK(memory.of_node(sizes, 4, 1) == doctest::Approx(70 + 4 * 1503));
  CHECK(memory.of_node(sizes, 1, 4) == doctest::Approx(1570 + 4 * 3));
  CHECK(memory.of_node(sizes, 2, 3) == doctest::Approx(70 + 2 * (1500 + 3 * 3)));
}

TEST_CASE(
    "A rank of the run of a billion elements needs what two workers were seen to have, within an eighth") {
  const mesh_sizes sizes{.background_elements = 1769589, .skeleton_sides = 20e6, .largest_piece = 720e3};
  CHECK(rank_memory{}.of_node(sizes, 1, 2) == doctest::Approx(2863e6).epsilon(0.125));
}
