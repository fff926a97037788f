#include "analytic_surfaces.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace dovetail;

namespace {

/// Two triangles over a part of a cylinder of radius 2 that turns by `angle`.
struct part_of_cylinder {
  test::cylinder cylinder{2};
  patch_boundary boundary;
  patch_mesh mesh;

  explicit part_of_cylinder(double angle) {
    boundary.uv = {{0, 0}, {angle, 0}, {angle, 1}, {0, 1}};
    for (const vec2 uv : boundary.uv)
      boundary.points.push_back(cylinder.frame(uv).point);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  }
  surface_deviation measure(double size) const {
    return measure_deviation(any_surface::view_of(cylinder), boundary, mesh, [size](vec3) { return size; });
  }
};

} // namespace

TEST_CASE("the deviation of a triangle is that of its centre along the normal, in units of the size") {
  const part_of_cylinder part(0.6);
  // The centre of a chord triangle with two corners on one side of the cylinder.
  const auto& p = part.boundary.points;
  const vec3 centre = (p[0] + p[1] + p[2]) / 3.0;
  const double height = 2 - dot(centre, {std::cos(0.4), std::sin(0.4), 0});
  const surface_deviation found = part.measure(0.5);
  CHECK(found.points == 0);
  CHECK(found.centres == doctest::Approx(height / 0.5));
  CHECK(part_of_cylinder(1.2).measure(0.5).centres > 3 * found.centres); // as the square of the angle
  CHECK(part.measure(0.25).centres == doctest::Approx(2 * found.centres));
}

TEST_CASE("points are measured from where their parameters are, inner ones too") {
  part_of_cylinder part(0.6);
  part.boundary.points[1].z += 0.1;
  CHECK(part.measure(0.5).points == doctest::Approx(0.2));
  part.mesh.inner_uv = {{0.3, 0.5}};
  part.mesh.inner_points = {part.cylinder.frame({0.3, 0.5}).point + vec3{0, 0, 0.3}};
  CHECK(part.measure(0.5).points == doctest::Approx(0.6));
}

TEST_CASE("reports keep the largest of all and of each face") {
  report first, all;
  note_deviation(first, "face 3", {0.1, 0.2});
  note_deviation(first, "face 4", {0.3, 0.1});
  note_deviation(first, "face 3", {0.2, 0.1});
  merge_deviations(all, first);
  CHECK(all.name == "deviation");
  CHECK(all.get("points") == 0.3);
  CHECK(all.get("centres") == 0.2);
  REQUIRE(all.children.size() == 2);
  CHECK(all.children[0].name == "face 3");
  CHECK(all.children[0].get("points") == 0.2);
  CHECK(all.children[0].get("centres") == 0.2);
}
