#include "view_scene.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "view_meshes.hpp"
#include "view_sides.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace dovetail::app {
namespace {

using names = std::vector<std::string>;

std::size_t of_label(const view_labels& labels, const std::string& name) {
  std::size_t count = 0;
  for (const local_id label : labels.of)
    count += labels.names[label] == name;
  return count;
}

/// Cubes whose elements have different angles.
io::loaded_mesh uneven_cubes(local_id cubes) {
  io::loaded_mesh row = testing::row_of_cubes(cubes);
  for (std::size_t v = 0; v < row.mesh.points.size(); ++v)
    row.mesh.points[v] += 0.02 * static_cast<double>(v * v % 11) * vec3{1, 0.5, 0.25};
  return row;
}

TEST_CASE("sides between subdomains are found, and belong to both") {
  const view_scene scene = scene_of(testing::cubes_in_pieces(2));
  CHECK(scene.dimension == 3);
  CHECK(scene.count == 12);
  CHECK(scene.vertices == 12);
  CHECK(scene.outer == 20);
  CHECK(scene.triangles.size() == 24);
  CHECK(scene.pieces.names == names{"piece 0", "piece 1"});
  CHECK(scene.groups.names == names{"surface", "between pieces"});
  CHECK(of_label(scene.groups, "between pieces") == 4);
  REQUIRE(scene.centres.size() == 2);
  CHECK(distance(scene.centres[0], {0.5, 0.5, 0.5}) < 1e-12);
  CHECK(distance(scene.centres[1], {1.5, 0.5, 0.5}) < 1e-12);
  CHECK(scene.least_angle == doctest::Approx(45));
}

TEST_CASE("triangles look away from their element") {
  const view_scene scene = scene_of(testing::cubes_in_pieces(3));
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto p = corners(span_of(scene.points), scene.triangles[t]);
    const auto q = corners(span_of(scene.points), scene.tetrahedra[scene.element_of[t]]);
    const vec3 middle = (q[0] + q[1] + q[2] + q[3]) / 4;
    CHECK(dot(cross(p[1] - p[0], p[2] - p[0]), middle - p[0]) < 0);
  }
}

TEST_CASE("without subdomains the materials are pieces; without both there is one") {
  io::loaded_mesh row = testing::row_of_cubes(2);
  CHECK(scene_of(row).triangles.size() == 20);
  CHECK(scene_of(row).pieces.names.size() == 1);
  row.mesh.tags = std::vector<local_id>(12, 3);
  std::fill(row.mesh.tags.begin() + 6, row.mesh.tags.end(), 5);
  row.material_names = {{5, "steel"}};
  const view_scene scene = scene_of(row);
  CHECK(scene.triangles.size() == 24);
  CHECK(scene.pieces.names == names{"material 3", "steel"});
  CHECK(scene.groups.names == names{"surface of material 3", "surface of steel", "between pieces"});
}

TEST_CASE("triangles of the file give groups to sides, also to those within a piece") {
  io::loaded_mesh row = testing::row_of_cubes(2);
  const auto plain = scene_of(row);
  row.triangles = {plain.triangles[0], {4, 5, 7}, {0, 1, 11}}; // the last one is no side
  std::swap(row.triangles[0][0], row.triangles[0][2]);         // whatever their order
  row.triangle_tags = {-2, 4, 8};                              // any number
  row.triangle_names = {{4, "film"}};
  const view_scene scene = scene_of(row);
  CHECK(scene.outer == 20);
  CHECK(of_label(scene.groups, "group -2") == 1);
  CHECK(of_label(scene.groups, "without a group") == 19);
  CHECK(of_label(scene.groups, "film") == 2);
  CHECK(scene.groups.names.size() == 3);
}

TEST_CASE("the outline is where the surface turns, ends, or changes its group") {
  CHECK(scene_of(testing::row_of_cubes(1)).outline.size() == 12);
  CHECK(scene_of(testing::row_of_cubes(2)).outline.size() == 16); // those along x have two pieces
  const view_scene flat = scene_of(testing::two_squares());
  CHECK(flat.outline.size() == 6 + 2);
}

TEST_CASE("triangles are elements of their own, whose groups are pieces") {
  const view_scene scene = scene_of(testing::two_squares());
  CHECK(scene.dimension == 2);
  CHECK(scene.count == 4);
  CHECK(scene.outer == 4);
  CHECK(scene.tetrahedra.empty());
  CHECK(scene.groups.names == names{"group 7", "right"});
  CHECK(scene.pieces.of == std::vector<local_id>{0, 0, 1, 1});
  CHECK(scene.least_angle == doctest::Approx(45));
}

TEST_CASE("subdomains of triangles are their pieces, where the file has them") {
  io::loaded_mesh flat = testing::two_squares();
  flat.triangle_subdomains = {3, 5, 5, 3};
  const view_scene scene = scene_of(flat);
  CHECK(scene.pieces.names == names{"piece 3", "piece 5"});
  CHECK(scene.pieces.of == std::vector<local_id>{0, 1, 1, 0});
  CHECK(scene.groups.of == std::vector<local_id>{0, 0, 1, 1});
  CHECK(scene.centres[0].x == doctest::Approx(1));
}

TEST_CASE("a part has all that fits, and says nothing of it") {
  const view_scene scene = scene_of(testing::cubes_in_pieces(2));
  const view_part part = part_that_fits(scene, 24 + 4 * 12);
  CHECK(part.triangles.size() == 24);
  CHECK(part.elements.size() == 12);
  CHECK(text_of_left_out(scene, part).empty());
}

TEST_CASE("of elements that do not fit there are the worst ones first, then spread ones, each once") {
  const view_scene scene = scene_of(uneven_cubes(5));
  const view_part part =
      part_that_fits(scene, static_cast<std::int64_t>(scene.triangles.size()) + 4 * 10 + 3);
  CHECK(part.triangles.size() == scene.triangles.size());
  REQUIRE(part.elements.size() == 10);
  CHECK(std::set<local_id>(part.elements.begin(), part.elements.end()).size() == 10);
  const auto angle = [&](local_id e) { return scene.angles[e]; };
  std::vector<float> sorted = scene.angles;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < 5; ++k)
    CHECK(angle(part.elements[k]) == sorted[k]);
  CHECK(std::is_sorted(part.elements.begin() + 5, part.elements.end()));
  CHECK(part.elements.back() - part.elements[5] > 12); // over the whole mesh of 30
  CHECK(text_of_left_out(scene, part) == "only 10 of 30 elements inside, half of them the worst");
}

TEST_CASE("no part has more than it may have; the outer surface goes first") {
  const view_scene scene = scene_of(testing::cubes_in_pieces(2));
  for (std::int64_t most = 1; most < 80; ++most) {
    const view_part part = part_that_fits(scene, most);
    CHECK(part.triangles.size() + 4 * part.elements.size() <= static_cast<std::size_t>(most));
    CHECK((part.elements.empty() || part.triangles.size() >= 20));
    const auto outer =
        std::count_if(part.triangles.begin(), part.triangles.end(), [](local_id t) { return t < 20; });
    CHECK(outer == std::min<std::int64_t>(most, 20));
  }
  CHECK(text_of_left_out(scene, part_that_fits(scene, 5)) ==
        "only 5 of 24 triangles of the surface and between pieces, none of 12 elements inside");
}

TEST_CASE("elements have a quarter of what the outer surface leaves, or all that nothing else needs") {
  const auto parts = [](const view_room& room) { return std::array{room.outer, room.inner, room.elements}; };
  using counts = std::array<std::size_t, 3>;
  CHECK(parts({100, 1000, 1000, 500}) == counts{100, 300, 25});
  CHECK(parts({100, 100, 1000, 500}) == counts{100, 100, 75});
  CHECK(parts({100, 1000, 5, 500}) == counts{100, 380, 5});
  CHECK(parts({600, 1000, 5, 500}) == counts{500, 0, 0});
  CHECK(parts({10, 10, 5, 500}) == counts{10, 10, 5});
}

TEST_CASE("sides are the same, and in the same order, however few are in memory at a time") {
  const io::loaded_mesh row = testing::row_of_cubes(4);
  const auto sides_of = [&](std::size_t most) {
    std::vector<std::vector<std::uint32_t>> found;
    for_each_side(
        span_of(row.mesh.elements), row.mesh.points.size(),
        [&](std::span<const std::uint32_t> members) { found.emplace_back(members.begin(), members.end()); },
        most);
    return found;
  };
  const auto together = sides_of(1000);
  CHECK(together.size() == (4 * 24 + 36) / 2); // 36 are outside
  for (const std::size_t most : {1, 10, 50})
    CHECK(sides_of(most) == together);
}

TEST_CASE("an angle under which no element is left out is known") {
  const view_scene scene = scene_of(uneven_cubes(5));
  const auto triangles = static_cast<std::int64_t>(scene.triangles.size());
  CHECK_FALSE(complete_under(scene, part_that_fits(scene, triangles + 4 * 30)));
  const auto under = complete_under(scene, part_that_fits(scene, triangles + 4 * 10));
  REQUIRE(under);
  CHECK(std::count_if(scene.angles.begin(), scene.angles.end(), [&](float a) { return a < *under; }) <= 5);
  CHECK(std::count_if(scene.angles.begin(), scene.angles.end(), [&](float a) { return a <= *under; }) >= 5);
  CHECK(complete_under(scene, part_that_fits(scene, 1)) == scene.least_angle);
}

TEST_CASE("the least angle is a number whatever the coordinates, so that elements can be sorted by it") {
  CHECK(least_angle_of(std::array<vec3, 4>{vec3{}, {1e200, 0, 0}, {0, 1e200, 0}, {0, 0, 1e200}}) >= 0);
  CHECK(least_angle_of(std::array<vec3, 4>{}) >= 0);
  CHECK(least_angle_of(std::array<vec3, 3>{vec3{}, {1, 0, 0}, {0, 1, 0}}) == doctest::Approx(45));
}

TEST_CASE("an element that names no point is refused") {
  io::loaded_mesh row = testing::row_of_cubes(1);
  row.mesh.elements[2][1] = 99;
  CHECK_THROWS_AS(scene_of(row), mesh_error);
  io::loaded_mesh flat = testing::two_squares();
  flat.triangles[3][0] = -1;
  CHECK_THROWS_AS(scene_of(flat), mesh_error);
}

} // namespace
} // namespace dovetail::app
