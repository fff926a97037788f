#include "dovetail/decomposition/extract_skeleton.hpp"
#include "skeleton/coarse_cube.hpp"

#include <doctest/doctest.h>

#include <set>

using namespace dovetail;
using dovetail_test::cube;

namespace {

std::vector<local_id> split_by_x(const background_mesh& mesh, double x) {
  std::vector<local_id> part;
  for (const auto& element : mesh.volume.elements) {
    double mean = 0;
    for (const local_id v : element)
      mean += mesh.volume.points[v].x / 4;
    part.push_back(mean < x ? 0 : 1);
  }
  return part;
}

} // namespace

TEST_CASE("two halves of a cube share the faces of the cut, once, oriented outwards of the first") {
  const background_mesh mesh = cube(4);
  const auto sides = build_sides(mesh.volume);
  const auto skeleton = extract_skeleton(mesh, sides, split_by_x(mesh, 0.5));
  REQUIRE(skeleton.faces.size() == 2 * 16);
  for (const skeleton_face& face : skeleton.faces) {
    CHECK(face.subdomains == std::array<local_id, 2>{0, 1});
    CHECK(face.vertices[0] == *std::min_element(face.vertices.begin(), face.vertices.end()));
    const auto at = [&](std::size_t i) { return mesh.volume.points[face.vertices[i]]; };
    const vec3 normal = cross(at(1) - at(0), at(2) - at(0));
    CHECK(at(0).x == 0.5);
    CHECK(normal.x > 0); // subdomain 0 is at smaller x
    CHECK(sorted_vertices(sides.vertices[face.side]) == sorted_vertices(face.vertices));
    std::size_t on_walls = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const vec3 middle = midpoint(at(i), at((i + 1) % 3));
      on_walls += middle.y == 0 || middle.y == 1 || middle.z == 0 || middle.z == 1 ? 1 : 0;
    }
    CHECK(face.is_curved == (on_walls > 0));
  }
}

TEST_CASE("regions are the cube's faces cut in two where the interface ends on them") {
  const background_mesh mesh = cube(4);
  const auto skeleton = extract_skeleton(mesh, build_sides(mesh.volume), split_by_x(mesh, 0.5));
  CHECK(skeleton.regions.size() == 2 + 4 * 2); // two faces whole, four halved
  std::size_t triangles = 0;
  std::set<std::pair<local_id, local_id>> keys;
  for (const skeleton_region& region : skeleton.regions) {
    triangles += region.triangles.size();
    CHECK(region.subdomains[1] == no_id);
    CHECK(region.fixed_points.empty());
    keys.emplace(region.cad_face, region.subdomains[0]);
  }
  CHECK(triangles == mesh.surface.mesh.elements.size());
  CHECK(keys.size() == skeleton.regions.size());
}

TEST_CASE("every edge of an interface face and every curve edge is a line with the host it lies on") {
  const background_mesh mesh = cube(4);
  const auto skeleton = extract_skeleton(mesh, build_sides(mesh.volume), split_by_x(mesh, 0.5));
  std::array<int, 4> of_dimension{};
  for (const skeleton_line& line : skeleton.lines)
    ++of_dimension[line.on.dimension];
  CHECK(of_dimension[1] == 12 * 4);              // the cube's edges
  CHECK(of_dimension[2] == 4 * 4);               // the outline of the cut on four faces
  CHECK(of_dimension[3] == 3 * 16 + 2 * 4 - 16); // the cut's edges but its outline
  for (const skeleton_face& face : skeleton.faces)
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(find_line(skeleton.lines, face.vertices[i], face.vertices[(i + 1) % 3]) != no_id);
  CHECK(find_line(skeleton.lines, 0, 124) == no_id);
  const line_index index(skeleton.lines);
  for (local_id a = 0; a < 126; ++a)
    for (local_id b = 0; b < 126; ++b)
      REQUIRE(index.find(a, b) == find_line(skeleton.lines, a, b));
  CHECK(line_index(std::vector<skeleton_line>{}).find(0, 1) == no_id);
}

TEST_CASE("a subdomain that touches the surface in a point only keeps that point in the region") {
  const background_mesh mesh = cube(4);
  std::vector<local_id> part(mesh.volume.elements.size(), 0);
  // The tetrahedra inside the cube at one inner point, without any that has a triangle on the surface.
  const auto sides = build_sides(mesh.volume);
  const local_id on_wall = 2 * 5 + 2; // the middle of the face z = 0
  for (std::size_t e = 0; e < part.size(); ++e) {
    const auto& element = mesh.volume.elements[e];
    int at_wall = 0;
    for (const local_id v : element)
      at_wall += mesh.volume.points[v].z == 0;
    if (at_wall == 1 && std::find(element.begin(), element.end(), on_wall) != element.end())
      part[e] = 1;
  }
  const auto skeleton = extract_skeleton(mesh, sides, part);
  REQUIRE(!skeleton.faces.empty());
  std::size_t fixed = 0;
  for (const skeleton_region& region : skeleton.regions)
    for (const local_id v : region.fixed_points) {
      CHECK(v == on_wall);
      ++fixed;
    }
  CHECK(fixed == 1);
}

TEST_CASE("a surface triangle that is no side of the volume is an error") {
  background_mesh mesh = cube(2);
  mesh.surface.mesh.elements.front() = {0, 13, 26}; // through the middle
  CHECK_THROWS_AS(elements_beside_surface(mesh, build_sides(mesh.volume)), mesh_error);
}
