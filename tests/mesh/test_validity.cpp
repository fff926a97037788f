#include "dovetail/mesh/validity.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

using namespace dovetail;

namespace {

/// The one fault of a mesh, with its examples.
template <int D>
fault_count only_fault(const simplicial_mesh<D>& mesh, const validity_options& allowed = {}) {
  const validity found = check_validity(mesh, allowed);
  INFO(found.text());
  REQUIRE(found.faults.size() == 1);
  return found.faults[0];
}

simplicial_mesh<2> cube_surface(int n) {
  const auto cubes = dovetail_test::jittered_cubes(n);
  const auto sides = build_sides(cubes);
  simplicial_mesh<2> surface;
  std::vector<local_id> number(cubes.points.size(), no_id);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s))) {
      simplex<2> triangle = sides.vertices[s];
      for (local_id& v : triangle) {
        auto& to = number[v];
        if (to == no_id) {
          to = static_cast<local_id>(surface.points.size());
          surface.points.push_back(cubes.points[v]);
        }
        v = to;
      }
      surface.elements.push_back(triangle);
    }
  return surface;
}

} // namespace

TEST_CASE("random meshes of solids and their surfaces are valid") {
  CHECK(check_validity(dovetail_test::jittered_cubes(5)).valid());
  CHECK(check_validity(cube_surface(4)).valid());
  CHECK(check_validity(dovetail_test::jittered_cubes(3)).text().empty());
}

TEST_CASE("an inverted tetrahedron is found exactly, and its sides disagree") {
  auto mesh = dovetail_test::jittered_cubes(2);
  std::swap(mesh.elements[7][1], mesh.elements[7][2]);
  const validity found = check_validity(mesh);
  CHECK(found.count(mesh_fault::inverted_element) == 1);
  CHECK(found.count(mesh_fault::misoriented_side) >= 1);
  CHECK(found.faults[0].examples == std::vector<local_id>{7});
}

TEST_CASE("volumes of one unit in the last place have the right sign") {
  const double tiny = std::numeric_limits<double>::denorm_min();
  simplicial_mesh<3> mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}}, {{0, 1, 2, 3}}, {}};
  CHECK(check_validity(mesh).count(mesh_fault::flat_element) == 1);
  mesh.points[3].z = tiny;
  CHECK(check_validity(mesh).valid());
  mesh.points[3].z = -tiny;
  CHECK(check_validity(mesh).count(mesh_fault::inverted_element) == 1);
}

TEST_CASE("a surface with a hole or with sheets that meet is refused unless allowed") {
  auto surface = cube_surface(3);
  surface.elements.pop_back();
  CHECK(only_fault(surface).kind == mesh_fault::open_boundary);
  CHECK(only_fault(surface).count == 3);
  CHECK(check_validity(surface, {.closed_boundary = false}).valid());

  simplicial_mesh<2> fin{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}, {}};
  CHECK(only_fault(fin, {.closed_boundary = false}).kind == mesh_fault::non_manifold_side);
  CHECK(check_validity(fin, {.closed_boundary = false, .non_manifold_sides = true}).valid());
}

TEST_CASE("a triangle turned over is found by its sides") {
  auto surface = cube_surface(3);
  std::swap(surface.elements[5][0], surface.elements[5][1]);
  const auto fault = only_fault(surface);
  CHECK(fault.kind == mesh_fault::misoriented_side);
  CHECK(fault.count == 3);
}

TEST_CASE("duplicates, isolated, coincident and broken points are each named") {
  auto mesh = dovetail_test::jittered_cubes(2);
  const auto whole = mesh;
  mesh.points.push_back({5, 5, 5});
  CHECK(only_fault(mesh).kind == mesh_fault::isolated_point);
  CHECK(only_fault(mesh).examples == std::vector<local_id>{27});
  CHECK(check_validity(mesh, {.isolated_points = true}).valid());

  mesh = whole;
  mesh.points.push_back(mesh.points[3]);
  CHECK(check_validity(mesh).count(mesh_fault::coincident_point) == 1);

  mesh = whole;
  mesh.elements.push_back(mesh.elements[4]);
  CHECK(check_validity(mesh).count(mesh_fault::duplicate_element) == 1);
  CHECK(check_validity(mesh).count(mesh_fault::non_manifold_side) >= 1);

  mesh = whole;
  mesh.elements[6][2] = 99;
  CHECK(only_fault(mesh).kind == mesh_fault::missing_point);

  mesh = whole;
  mesh.elements[6][2] = mesh.elements[6][1];
  CHECK(check_validity(mesh).count(mesh_fault::repeated_vertex) == 1);

  mesh = whole;
  mesh.points[13].y = std::numeric_limits<double>::quiet_NaN();
  CHECK(only_fault(mesh).kind == mesh_fault::non_finite_point);

  mesh = whole;
  mesh.tags = {1, 2};
  CHECK(only_fault(mesh).kind == mesh_fault::tags_mismatch);
  CHECK(check_validity(mesh).text() == "1 x tags mismatch");
}

TEST_CASE("all coincident points are found, also among many of the same x") {
  simplicial_mesh<3> mesh; // of points alone
  for (int i = 0; i < 40; ++i)
    mesh.points.push_back(
        {i % 2 == 0 ? 0.0 : -0.0, static_cast<double>(i * 7 % 13), static_cast<double>(i % 3)});
  std::vector<local_id> expected;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (std::find(mesh.points.begin(), mesh.points.begin() + static_cast<std::ptrdiff_t>(i),
                  mesh.points[i]) != mesh.points.begin() + static_cast<std::ptrdiff_t>(i))
      expected.push_back(static_cast<local_id>(i));
  REQUIRE(expected.size() == 1); // 13 x 3 places
  mesh.points.push_back(mesh.points[5]);
  mesh.points.push_back(mesh.points[5]);
  expected.push_back(40);
  expected.push_back(41);
  const fault_count found = only_fault(mesh, {.isolated_points = true});
  CHECK(found.kind == mesh_fault::coincident_point);
  CHECK(found.examples == expected);
}

TEST_CASE("a lone tetrahedron listed twice, or once as its mirror image, is a duplicate") {
  simplicial_mesh<3> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.elements = {{0, 1, 2, 3}, {1, 2, 0, 3}};
  CHECK(check_validity(mesh).count(mesh_fault::duplicate_element) == 1);
  mesh.elements[1] = {1, 0, 2, 3};
  CHECK(check_validity(mesh).count(mesh_fault::duplicate_element) == 1);
  CHECK(check_validity(mesh).count(mesh_fault::inverted_element) == 1);
}
