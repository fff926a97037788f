/// The check at the entry of stages: valid meshes pass; of others the first fault is named, with its numbers.
#include "dovetail/mesh/require_valid.hpp"
#include "support/jittered_meshes.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace dovetail;
using testing::has;

namespace {

template <int D>
std::string refusal(const simplicial_mesh<D>& mesh, const mesh_demands& demands = {}) {
  return testing::refusal_of<mesh_error>([&] {
    require_valid(mesh, "the stage", demands);
    return 0;
  });
}

} // namespace

TEST_CASE("valid meshes pass, with tags and without") {
  auto solid = dovetail_test::jittered_cubes(4);
  CHECK(refusal(solid) == "accepted");
  solid.tags.assign(solid.elements.size(), 3);
  CHECK(refusal(solid) == "accepted");
  CHECK(refusal(dovetail_test::jittered_squares(6)) == "accepted");
  CHECK(refusal(simplicial_mesh<3>{}) == "accepted");
}

TEST_CASE("points that are not finite are named with their coordinates") {
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto mesh = dovetail_test::jittered_cubes(2);
    mesh.points[5].y = wrong;
    const std::string message = refusal(mesh);
    CHECK(has(message, "the stage: point 5 is at ("));
    CHECK(has(message, std::isnan(wrong) ? "nan" : "inf"));
    CHECK(has(message, "give finite coordinates"));
  }
}

TEST_CASE("indices out of range, repeated points and tags of another number are named") {
  auto mesh = dovetail_test::jittered_cubes(2);
  mesh.elements[7][2] = 27;
  CHECK(has(refusal(mesh), "element 7 refers to point 27, but the mesh has 27 points"));
  mesh.elements[7][2] = -1;
  CHECK(has(refusal(mesh), "element 7 refers to point -1"));
  mesh.elements[7][2] = mesh.elements[7][0];
  CHECK(has(refusal(mesh), "element 7 uses point " + std::to_string(mesh.elements[7][0]) + " twice"));
  mesh = dovetail_test::jittered_cubes(2);
  mesh.tags.assign(5, 0);
  CHECK(has(refusal(mesh), "5 tags for 48 elements"));
}

TEST_CASE("an inverted tetrahedron is named with its points and volume, exactly") {
  auto mesh = dovetail_test::jittered_cubes(2);
  std::swap(mesh.elements[7][0], mesh.elements[7][1]);
  const std::string message = refusal(mesh);
  CHECK(has(message, "element 7 (points "));
  CHECK(has(message, "is inverted: its volume is -"));
  CHECK(has(message, "swap two of its points"));
  CHECK(refusal(mesh, {.orientation = false}) == "accepted");

  const double least = std::numeric_limits<double>::denorm_min();
  simplicial_mesh<3> flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.25, 0}}, {{0, 1, 2, 3}}, {}};
  CHECK(has(refusal(flat), "element 0 (points 0, 1, 2, 3) is flat"));
  flat.points[3].z = least;
  CHECK(refusal(flat) == "accepted");
  flat.points[3].z = -least;
  CHECK(has(refusal(flat), "inverted"));
}

TEST_CASE("an element that is there twice is named with the other one, and one that overlaps its neighbour") {
  auto mesh = dovetail_test::jittered_cubes(2);
  mesh.elements.push_back(mesh.elements[7]);
  CHECK(has(refusal(mesh), "element 48 has the same points ("));
  CHECK(has(refusal(mesh), "as element 7; remove one of them"));

  simplicial_mesh<3> two{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}}, {}, {}};
  two.elements = {{0, 1, 2, 3}, {0, 1, 2, 3}};
  CHECK(has(refusal(two), "element 1 has the same points (0, 1, 2, 3) as element 0"));
  two.elements[1][3] = 4;
  CHECK(has(refusal(two), "the elements 0 and 1 overlap"));
  two.points.push_back({0, 0, -1});
  two.elements.push_back({0, 2, 1, 5});
  CHECK(has(refusal(two), "the elements 0, 1, 2 all have the side (0, 2, 1)"));
}

TEST_CASE(
    "a triangle that is turned over is named with its neighbour; of two faces each has its orientation") {
  auto mesh = dovetail_test::jittered_squares(4);
  std::swap(mesh.elements[9][0], mesh.elements[9][1]);
  const std::string message = refusal(mesh);
  CHECK(has(message, "in the same direction"));
  CHECK((testing::contains(message, "elements 9 and ") || testing::contains(message, " and 9 pass")));
  mesh.tags.assign(mesh.elements.size(), 0);
  CHECK(has(refusal(mesh), "in the same direction"));
  mesh.tags[9] = 1;
  CHECK(refusal(mesh) == "accepted");

  mesh = dovetail_test::jittered_squares(4);
  mesh.points.push_back(midpoint(mesh.points[0], mesh.points[1]));
  mesh.elements.push_back({0, 1, static_cast<local_id>(mesh.points.size()) - 1});
  CHECK(has(refusal(mesh), "is flat: its area is 0"));
}

TEST_CASE("triangles may be there twice as two faces, and three may meet at an edge") {
  simplicial_mesh<2> lens{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 1}}, {0, 1}};
  CHECK(refusal(lens) == "accepted");
  lens.elements.push_back({0, 1, 3});
  lens.tags.push_back(2);
  CHECK(refusal(lens) == "accepted");
  lens.tags[1] = 0;
  CHECK(has(refusal(lens), "element 1 has the same points"));
}

TEST_CASE("sides of another mesh are refused") {
  const auto mesh = dovetail_test::jittered_cubes(2), other = dovetail_test::jittered_cubes(3);
  const auto told = [&](const side_table<3>& sides) {
    return testing::refusal_of<mesh_error>([&] {
      require_valid(mesh, sides);
      return 0;
    });
  };
  CHECK(told(build_sides(mesh)) == "accepted");
  CHECK(has(told(build_sides(other)), "the sides are not those of the mesh: they are of 162 elements"));
  auto renumbered = mesh;
  std::swap(renumbered.elements[3], renumbered.elements[40]);
  CHECK(has(told(build_sides(renumbered)), "element 3 has no side with the points"));
}
