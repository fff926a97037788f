#include "analytic_surfaces.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/surface_deviation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

namespace {

/// Two half planes that meet at the line u = 0, where the second one turns up by an angle; over a width it
/// does so by and by.
struct bent_plane {
  double angle = 0;
  double width = 0;

  surface_frame frame(vec2 uv) const {
    const double radius = width / angle;
    const double turned = width > 0 ? std::clamp(uv.x / radius, 0.0, angle) : uv.x > 0 ? angle : 0.0;
    const double in_bend = radius * turned;
    const vec3 along{std::cos(turned), 0, std::sin(turned)};
    vec3 point = (uv.x - (uv.x > 0 ? in_bend : 0)) * (uv.x > 0 ? along : vec3{1, 0, 0});
    point += vec3{radius * std::sin(turned), uv.y, radius * (1 - std::cos(turned))};
    return {point, along, {0, 1, 0}};
  }
  vec2 project(vec3, vec2 seed) const { return seed; }
};

surface_deviation deviation_of_bend(const bent_plane& surface) {
  patch_boundary boundary;
  boundary.uv = {{-0.45, 0}, {0.55, 0.1}, {-0.4, 0.9}};
  for (const vec2 uv : boundary.uv)
    boundary.points.push_back(surface.frame(uv).point);
  patch_mesh mesh;
  mesh.triangles = {{0, 1, 2}};
  return measure_deviation(any_surface::view_of(surface), boundary, mesh, [](vec3) { return 1.0; });
}

} // namespace

TEST_CASE("a triangle that steps over an edge of its surface is told from one that is large") {
  const double right = std::numbers::pi / 2;
  const surface_deviation sharp = deviation_of_bend({right, 0});
  CHECK(sharp.centres > noticed_distance);
  CHECK(sharp.cut_off == sharp.centres);
  CHECK(deviation_of_bend({right, 1e-3}).cut_off > 0);
  CHECK(deviation_of_bend({right, 0.5}).centres > noticed_distance);
  CHECK(deviation_of_bend({right, 0.5}).cut_off == 0);
  CHECK(deviation_of_bend({0.5, 0}).cut_off == 0); // a feature of a model of triangles turns by more
  for (const double turn : {1.2, 2.0, 3.0})
    CHECK(part_of_cylinder(turn).measure(1).cut_off == 0);
}

TEST_CASE("the gap is the volume between triangles and surface, about") {
  const part_of_cylinder part(0.6);
  const double between = 0.5 * 4 * (0.6 - std::sin(0.6)); // the segment of the disc, one high
  CHECK(part.measure(1).gap == doctest::Approx(between).epsilon(0.4));
  report noted;
  note_deviation(noted, "face 3", part.measure(1));
  note_deviation(noted, "face 3", part.measure(1));
  CHECK(noted.get("gap") == 2 * part.measure(1).gap);
}

TEST_CASE("faces that edges were cut off from are warned of, the first ones by name") {
  report noted, told;
  note_deviation(noted, "face 0", {0.1, 0.3, 0, 0});
  warn_of_deviations(told, noted);
  CHECK(told.warnings.empty());
  note_deviation(noted, "face 1", {0, 0.3, 0.25, 0});
  note_deviation(noted, "face 2", {0, 1.5, 0, 0});
  warn_of_deviations(told, noted);
  REQUIRE(told.warnings.size() == 2);
  CHECK(told.warnings[0].find("as far as 0.25 of its local size from face 1: it cuts off an edge") !=
        std::string::npos);
  CHECK(told.warnings[1].find("as far as 1.5 of its local size from face 2, which no size explains") !=
        std::string::npos);
  for (int f = 3; f < 20; ++f)
    note_deviation(noted, "face " + std::to_string(f), {0, 0.3, 0.25, 0});
  told = {};
  warn_of_deviations(told, noted);
  CHECK(told.warnings.size() == 7);
  CHECK(told.warnings.back() == "so are the meshes of 13 other faces");
  report both, of_both; // cut off, and far in the middle of triangles: that is one thing to be told
  for (int f = 0; f < 7; ++f)
    note_deviation(both, "face " + std::to_string(f), {0, 1.5, 1.5, 0});
  warn_of_deviations(of_both, both);
  CHECK(of_both.warnings.size() == 6);
  CHECK(of_both.warnings.back() == "so are the meshes of 2 other faces");
}
