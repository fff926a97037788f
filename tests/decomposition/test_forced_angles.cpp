#include "dovetail/decomposition/forced_angles.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/quality.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

using namespace dovetail;

namespace {

/// An interface triangle between two subdomains, and CAD around it.
struct interface_on_cad {
  fine_skeleton skeleton;

  explicit interface_on_cad(std::vector<vec3> points) {
    skeleton.points = std::move(points);
    add({0, 1, 2}, {0, 1}, no_id);
  }
  void add(simplex<2> triangle, std::array<local_id, 2> subdomains, local_id face) {
    skeleton.sides.own().push_back(triangle);
    skeleton.subdomains.own().push_back(subdomains);
    skeleton.side_hosts.own().push_back(face);
  }
  void add_curve(simplex<1> edge, local_id curve) {
    skeleton.curve_edges.push_back(edge);
    skeleton.curves.push_back(curve);
  }
  interface_angles measure(double size) const {
    constexpr wanted_angles wanted{30, 30};
    auto angles = measure_skeleton_angles(skeleton, wanted);
    find_forced(
        angles, skeleton.sides, cad_of(skeleton), [size](vec3) { return size; }, wanted);
    return angles;
  }
};

vec3 at_angle(double degrees, double length = 1) {
  const double a = degrees / degrees_per_radian;
  return {length * std::cos(a), length * std::sin(a), 0};
}

/// The floor of a dihedral with an opening of 20 degrees about the z axis.
interface_on_cad in_sharp_dihedral(bool seen_from_outside) {
  interface_on_cad dihedral({{0, 0, 0}, {1, 0, 0}, at_angle(20), {0, 0, 1}});
  simplex<2> front{0, 1, 3}, back{0, 3, 2};
  if (seen_from_outside) {
    std::swap(front[1], front[2]);
    std::swap(back[1], back[2]);
  }
  dihedral.add(front, {0, no_id}, 4);
  dihedral.add(back, {0, no_id}, 5);
  dihedral.add_curve({0, 3}, 7);
  return dihedral;
}

} // namespace

TEST_CASE("an interface in a sharp dihedral of the CAD is forced, and its curve and faces are named") {
  const auto angles = in_sharp_dihedral(false).measure(0.1);
  REQUIRE(angles.violations.size() == 1);
  CHECK(angles.violations[0].angle_deg == doctest::Approx(20));
  CHECK(angles.violations[0].cause == violation_cause::forced);
  CHECK(angles.violations[0].cad == std::vector<host>{{1, 7}, {2, 4}, {2, 5}});
  CHECK(angles.count(violation_cause::forced) == 1);
}

TEST_CASE("a slit that the domain lies around forces nothing; what the triangle touches is named") {
  const auto angles = in_sharp_dihedral(true).measure(0.1);
  REQUIRE(angles.violations.size() == 1);
  CHECK(angles.violations[0].cause == violation_cause::remeshing);
  CHECK(angles.violations[0].cad == std::vector<host>{{2, 4}, {2, 5}});
}

TEST_CASE("a wedge of another solid between two faces forces an angle, though it is in front of both") {
  interface_on_cad wedge = in_sharp_dihedral(true);
  for (std::size_t t = 1; t < 3; ++t)
    wedge.skeleton.subdomains.own()[t][1] = 1;
  const auto angles = wedge.measure(0.1);
  REQUIRE(angles.violations.size() == 1);
  CHECK(angles.violations[0].cause == violation_cause::forced);
}

TEST_CASE("a dihedral between an interface and the CAD is forced at a sharp edge only") {
  for (const double opening : {25.0, 60.0}) {
    // The interface leaves the z axis, between two faces that meet there.
    interface_on_cad dihedral({{0, 0, 0}, {0, 0, 1}, at_angle(0.4 * opening), {1, 0, 0}, at_angle(opening)});
    dihedral.add({0, 3, 1}, {0, no_id}, 4);
    dihedral.add({0, 1, 4}, {1, no_id}, 5);
    dihedral.add_curve({1, 0}, 7);
    const auto angles = dihedral.measure(0.1);
    CHECK(angles.violations.size() == (opening < 30 ? 2 : 1));
    for (const angle_violation& v : angles.violations)
      CHECK(v.cause == (opening < 30 ? violation_cause::forced : violation_cause::remeshing));
  }
}

TEST_CASE("curves that meet at a small angle force the corner between them") {
  interface_on_cad corner({{0, 0, 0}, {1, 0, 0}, at_angle(20)});
  corner.add_curve({0, 1}, 2);
  CHECK(corner.measure(0.1).count(violation_cause::forced) == 0);
  corner.add_curve({2, 0}, 3);
  const auto angles = corner.measure(0.1);
  REQUIRE(angles.count(violation_cause::forced) == 1);
  CHECK(angles.violations[0].cad == std::vector<host>{{1, 2}, {1, 3}});
}

TEST_CASE("a curve, and a face's width, force an angle where they are short beside the size") {
  const std::vector<vec3> points{{0, 0, 0}, at_angle(-10), at_angle(10), {1.1, 0, 0.3}};
  interface_on_cad curve(points);
  curve.add_curve({1, 2}, 6);
  CHECK(curve.measure(0.3).count(violation_cause::forced) == 0);
  const auto by_curve = curve.measure(1);
  REQUIRE(by_curve.count(violation_cause::forced) == 1);
  CHECK(by_curve.violations[0].cad == std::vector<host>{{1, 6}});

  interface_on_cad face(points);
  face.add({1, 2, 3}, {0, no_id}, 8);
  CHECK(face.measure(1).count(violation_cause::forced) == 0); // nothing bounds the face here
  face.add_curve({1, 3}, 6);
  face.add_curve({2, 3}, 7);
  CHECK(face.measure(0.3).count(violation_cause::forced) == 0);
  const auto by_face = face.measure(1);
  CHECK(by_face.count(violation_cause::forced) == 1);
  CHECK(by_face.violations[0].cad == std::vector<host>{{2, 8}});
}

TEST_CASE("a corner of triangles is forced where fixed sides meet at less than the threshold") {
  simplicial_mesh<2> mesh; // two triangles cut apart in a corner of 40 degrees, and of 90
  for (const double opening : {40.0, 90.0}) {
    mesh.points = {{0, 0, 0}, {1, 0, 0}, at_angle(opening / 2), at_angle(opening)};
    mesh.elements = {{0, 1, 2}, {0, 2, 3}};
    mesh.tags = {3, 3};
    const auto sides = build_sides(mesh);
    std::vector<side_state> states;
    for (std::size_t s = 0; s < sides.size(); ++s)
      states.push_back(sides.is_interior(static_cast<local_id>(s)) ? side_state::kept : side_state::fixed);
    const std::vector<local_id> parts{0, 1};
    const auto angles = measure_interface_angles<2>({mesh, sides, states, parts}, {0, 50});
    CHECK(angles.count(violation_cause::forced) == (opening < 50 ? 2 : 0));
    std::size_t at_corner = 0;
    for (const angle_violation& v : angles.violations)
      if (v.edge[0] == 0) {
        ++at_corner;
        CHECK(v.cad == std::vector<host>{{2, 3}});
        CHECK(v.place == vec3{0, 0, 0});
      }
    CHECK(at_corner == 2);
  }
}
