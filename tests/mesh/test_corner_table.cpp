#include "dovetail/mesh/corner_table.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>

using namespace dovetail;

namespace {

/// The triangles, each from its least vertex on.
std::set<std::array<local_id, 3>> triangles_of(const corner_table& table) {
  std::set<std::array<local_id, 3>> found;
  for (local_id t = 0; t < table.triangle_slots(); ++t)
    if (table.alive(t)) {
      std::array triangle{table.vertex[3 * t], table.vertex[3 * t + 1], table.vertex[3 * t + 2]};
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
      found.insert(triangle);
    }
  return found;
}

} // namespace

TEST_CASE("the diagonal of a square is flipped, a vertex put inside and taken away again") {
  // part flip
  corner_table square;
  for (int v = 0; v < 4; ++v)
    square.add_vertex();
  square.add_triangle(0, 1, 2); // corners 0, 1, 2
  square.add_triangle(0, 2, 3); // corners 3, 4, 5
  square.glue(1, 5);            // what is opposite vertex 1 and vertex 3: the diagonal from 0 to 2
  square.flip(1);               // to the one from 1 to 3
  // end
  const std::set<std::array<local_id, 3>> flipped{{0, 1, 3}, {1, 2, 3}};
  CHECK(triangles_of(square) == flipped);

  const local_id middle = square.add_vertex();
  const local_id beside_two = corner_table::triangle_of(square.corner_of[2]);
  const auto parts = square.split_triangle(beside_two, middle);
  CHECK(triangles_of(square) ==
        std::set<std::array<local_id, 3>>{{0, 1, 3}, {1, 2, 4}, {2, 3, 4}, {1, 4, 3}});
  for (const local_id part : parts)
    CHECK(square.vertex[3 * part + 2] == middle);
  int around = 0;
  square.for_each_corner(middle, [&](local_id c) { around += square.vertex[c] == middle ? 1 : 0; });
  CHECK(around == 3);

  local_id towards_two = no_id; // the corner opposite the side from the middle to vertex 2
  for (local_id c = 0; c < 3 * square.triangle_slots(); ++c)
    if (square.vertex[c] != no_id && square.tail(c) == middle && square.head(c) == 2)
      towards_two = c;
  REQUIRE(towards_two != no_id);
  CHECK(square.free_side(towards_two));
  square.collapse(towards_two);
  CHECK(triangles_of(square) == flipped);
}
