#include "dovetail/core/error.hpp"
#include "dovetail/mesher/enclosed_regions.hpp"
#include "mesher/shapes.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <utility>

using namespace dovetail;

namespace {

using pair = std::array<local_id, 2>;

/// Checks what is beside the triangles [first, last).
void check_beside(const enclosed_regions& regions, std::size_t first, std::size_t last, pair expected) {
  for (std::size_t t = first; t < last; ++t)
    CHECK_MESSAGE(regions.beside()[t] == expected, "triangle ", t);
}

} // namespace

TEST_CASE("shells in shells are regions around each other, by whatever orientation") {
  for (const bool inwards : {false, true}) {
    auto s = shapes::cube(2, 8);
    shapes::append(s, shapes::cube(2, 4, {2, 2, 2}), inwards);
    shapes::append(s, shapes::sphere(1, 1, {4, 4, 4}));
    shapes::append(s, shapes::sphere(1, 0.5, {7, 7, 7}));
    const enclosed_regions regions(s);
    REQUIRE(regions.count() == 4);
    check_beside(regions, 0, 48, {0, no_id});
    check_beside(regions, 48, 96, inwards ? pair{0, 1} : pair{1, 0});
    check_beside(regions, 96, 176, {2, 1});
    check_beside(regions, 176, 256, {3, 0});
    CHECK(regions.at({0.5, 4, 4}) == 0);
    CHECK(regions.at({2.5, 4, 4}) == 1);
    CHECK(regions.at({4, 4, 4}) == 2);
    CHECK(regions.at({7, 7, 7}) == 3);
    CHECK(regions.at({9, 4, 4}) == no_id);
    CHECK(regions.at({-1, 4, 4}) == no_id);
    CHECK(regions.at({4, 4, 1}) == 0); // a ray through edges and corners
    CHECK(regions.at({1, 2, 2}) == 0);
  }
}

TEST_CASE("an edge of four triangles joins those that face each other") {
  // Two cubes with an edge in common are two regions: around the edge lies the outside between them.
  const auto s = shapes::cells({{0, 0, 0}, {1, 1, 0}}, {1, 1, 1});
  const enclosed_regions regions(s);
  CHECK(regions.count() == 2);
  check_beside(regions, 0, 12, {0, no_id});
  check_beside(regions, 12, 24, {1, no_id});
}

TEST_CASE("two shells with a corner in common") {
  // Of a cube in a corner of another one, only a tetrahedron's corner is that of the cube.
  auto s = shapes::cube(1);
  const auto first = static_cast<local_id>(s.points.size());
  s.points.push_back({0.5, 0.2, 0.2});
  s.points.push_back({0.2, 0.5, 0.2});
  s.points.push_back({0.2, 0.2, 0.5});
  local_id corner = no_id;
  for (local_id v = 0; v < first; ++v)
    if (s.points[v] == vec3{0, 0, 0})
      corner = v;
  REQUIRE(corner != no_id);
  const local_id a = first, b = first + 1, c = first + 2;
  for (const simplex<2>& t : {simplex<2>{a, b, c}, {corner, b, a}, {corner, c, b}, {corner, a, c}})
    s.elements.push_back(t);
  const enclosed_regions regions(s);
  CHECK(regions.count() == 2);
  check_beside(regions, 0, 12, {0, no_id});
  check_beside(regions, 12, 16, {1, 0});
}

TEST_CASE("open edges, and triangles upon each other, are named") {
  auto s = shapes::cube(2);
  s.elements.pop_back();
  CHECK_THROWS_WITH_AS(enclosed_regions{s},
                       doctest::Contains("has one triangle only; close the surface there"), geometry_error);
  s = shapes::cube(1);
  // A second lid upon the first one, divided in its middle, shares the edges of the first.
  const simplex<2> lid = s.elements[0];
  const auto middle = static_cast<local_id>(s.points.size());
  s.points.push_back((s.points[lid[0]] + s.points[lid[1]] + 2.0 * s.points[lid[2]]) / 4.0);
  for (std::size_t k = 0; k < 3; ++k)
    s.elements.push_back({lid[k], lid[(k + 1) % 3], middle});
  CHECK_THROWS_AS(enclosed_regions{s}, geometry_error);
}
