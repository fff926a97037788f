#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/element_labels.hpp"
#include "mesher/shapes.hpp"

#include <doctest/doctest.h>

#include <utility>

using namespace dovetail;

namespace {

/// Two tetrahedra on a common triangle (0, 1, 2), and their hull.
simplicial_mesh<3> two_tetrahedra() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}}, {{0, 1, 2, 3}, {0, 2, 1, 4}}, {}};
}
mesher_input<3> hull_of_both() {
  const auto mesh = two_tetrahedra();
  mesher_input<3> input;
  input.boundary.points = mesh.points;
  for (const auto& element : mesh.elements)
    for (std::size_t i = 0; i < 3; ++i)
      input.boundary.elements.push_back(detail::pick(element, numbering::sides<3>[i]));
  return input;
}

} // namespace

TEST_CASE("A right result passes the checks") {
  CHECK_NOTHROW(check_mesher_result(hull_of_both(), two_tetrahedra()));
}

TEST_CASE("A lost element is found") {
  auto mesh = two_tetrahedra();
  mesh.elements.pop_back();
  CHECK_THROWS_WITH_AS(check_mesher_result(hull_of_both(), mesh), "3 of 6 boundary triangles are lost",
                       mesher_error);
}

TEST_CASE("A moved point is found, whatever the distance") {
  auto mesh = two_tetrahedra();
  mesh.points[1].x = std::nextafter(1.0, 2.0);
  CHECK_THROWS_WITH_AS(check_mesher_result(hull_of_both(), mesh), "boundary point 1 was moved", mesher_error);
}

TEST_CASE("A lost point is found") {
  auto mesh = two_tetrahedra();
  mesh.points.pop_back();
  mesh.elements.pop_back();
  CHECK_THROWS_AS(check_mesher_result(hull_of_both(), mesh), mesher_error);
}

TEST_CASE("Elements on both sides of an outer triangle are found") {
  auto input = hull_of_both();
  input.boundary.elements = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}; // the upper one alone
  CHECK_THROWS_AS(check_mesher_result(input, two_tetrahedra()), mesher_error);
}

TEST_CASE("An inverted or flat element is found") {
  auto inverted = two_tetrahedra();
  std::swap(inverted.elements[0][0], inverted.elements[0][1]);
  CHECK_THROWS_AS(check_mesher_result(hull_of_both(), inverted), mesher_error);
  auto input = hull_of_both();
  auto flat = two_tetrahedra();
  flat.points[3] = input.boundary.points[3] = {0.2, 0.2, 0};
  CHECK_THROWS_AS(check_mesher_result(input, flat), mesher_error);
}

TEST_CASE("Missing volume is found even when the boundary is whole") {
  // A cavity inside that no boundary triangle lists.
  const auto outer = shapes::cube(1, 3);
  simplicial_mesh<3> mesh{outer.points, {}, {}};
  const auto center = static_cast<local_id>(mesh.points.size());
  mesh.points.push_back({1.5, 1.5, 1.5});
  for (const auto& t : outer.elements)
    mesh.elements.push_back({t[0], t[2], t[1], center});
  CHECK_NOTHROW(check_mesher_result({outer, 0}, mesh));
  mesh.points.push_back({2.9, 1.5, 1.5});
  mesh.elements.front()[3] = center + 1; // positive still, but another shape
  CHECK_THROWS_AS(check_mesher_result({outer, 0}, mesh), mesher_error);
}

TEST_CASE("A lost inner element is found, however small it is beside the whole") {
  const auto input = hull_of_both();
  auto mesh = two_tetrahedra();
  const vec3 p{0.2, 0.2, 0.2};
  mesh.points.push_back(p); // 5, in the first element
  mesh.points.push_back(p + 1e-12 * (mesh.points[0] + mesh.points[2] + mesh.points[3] - 3.0 * p)); // 6
  mesh.elements = {{5, 1, 2, 3}, {0, 1, 5, 3}, {0, 1, 2, 5}, {0, 2, 1, 4},
                   {0, 6, 2, 3}, {0, 5, 6, 3}, {0, 5, 2, 6}, {6, 5, 2, 3}};
  CHECK_NOTHROW(check_mesher_result(input, mesh));
  mesh.elements.pop_back();
  CHECK_THROWS_WITH_AS(check_mesher_result(input, mesh),
                       "the elements do not fit together inside the boundary: some are lost, doubled or "
                       "turned over",
                       mesher_error);
}

TEST_CASE("The volume check does not lose digits far from the origin") {
  const auto outer = shapes::cube(1, 1, {1e6, 1e6, 1e6});
  CHECK(enclosed_volume(outer.points, outer.elements) == doctest::Approx(1).epsilon(1e-9));
}

TEST_CASE("Elements are labelled by the material behind each triangle") {
  const auto mesh = two_tetrahedra();
  auto input = hull_of_both();
  auto& triangles = input.boundary.elements;
  std::vector<local_id> labels{4, 4, 4, 9, 9, 9};
  CHECK_THROWS_AS(label_elements(mesh, triangles, labels), mesher_error); // nothing separates 4 from 9
  triangles.push_back({0, 2, 1});                                         // outwards of the upper element
  triangles.push_back({0, 1, 2});
  labels.push_back(4);
  labels.push_back(9);
  CHECK(label_elements(mesh, triangles, labels) == std::vector<local_id>{4, 9});
}

TEST_CASE("Elements in front of the boundary are dropped with their points") {
  auto mesh = two_tetrahedra();
  const std::vector<simplex<2>> upper{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const auto labels = label_elements(mesh, upper);
  CHECK(labels == std::vector<local_id>{0, no_id});
  drop_outside(mesh, labels, 4);
  CHECK(mesh.elements == std::vector<simplex<3>>{{0, 1, 2, 3}});
  CHECK(mesh.points.size() == 4);
}

TEST_CASE("A boundary listed twice in one direction is refused, in both it is an interface") {
  const std::vector<simplex<2>> twice{{0, 1, 2}, {1, 2, 0}};
  CHECK_THROWS_AS(boundary_sides{twice}, mesher_error);
  const std::vector<simplex<2>> both{{0, 1, 2}, {1, 0, 2}};
  const boundary_sides sides(both);
  REQUIRE(sides.entries().size() == 1);
  CHECK(sides.listed(sides.find({2, 0, 1})) == 0);
  CHECK(sides.listed(sides.find({0, 2, 1})) == 1);
  CHECK_FALSE(sides.find({0, 1, 3}));
  CHECK_FALSE(sides.find({0, 1, -1}));
  CHECK(sides.triangles() == both);
  CHECK(sides.vertex_count() == 3);
  CHECK(sides.may_have(0));
  CHECK(sides.may_have(2));
  CHECK_FALSE(sides.may_have(3));
  CHECK_FALSE(sides.may_have(-1));
  const boundary_sides none({});
  CHECK_FALSE(none.may_have(0));
  CHECK_FALSE(none.find({0, 1, 2}));
}
