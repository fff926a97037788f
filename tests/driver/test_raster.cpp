#include "raster_render.hpp"

#include <doctest/doctest.h>

namespace dovetail::app {
namespace {

constexpr rgb red{200, 0, 0};
constexpr rgb blue{0, 0, 200};

/// The plane z = 0 seen from above: a picture of n x n pixels shows [0, n] x [0, n], y upwards.
raster_view plane_view(double n) {
  raster_view view;
  view.center = {n / 2, n / 2, 0};
  view.height = n;
  return view;
}

raster_triangle triangle(vec3 a, vec3 b, vec3 c, rgb colour) {
  return {{a, b, c}, colour};
}

bool is_shade_of(rgb pixel, rgb colour) {
  return pixel != white && (pixel.red > 0) == (colour.red > 0) && (pixel.blue > 0) == (colour.blue > 0);
}

TEST_CASE("a triangle colours exactly the pixels whose centers it covers") {
  raster_scene scene;
  scene.triangles = {triangle({1, 1, 0}, {7, 1, 0}, {1, 7, 0}, red)};
  const raster_image image = render(scene, plane_view(10), 10, 10, 1);
  int covered = 0;
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10; ++column) {
      const double x = column + 0.5;
      const double y = 10 - (row + 0.5); // the top row first
      const bool inside = x >= 1 && y >= 1 && x + y <= 8;
      CHECK(is_shade_of(image.at(column, row), red) == inside);
      covered += inside;
    }
  CHECK(covered == 21);
}

TEST_CASE("what is nearer hides what is behind, in either order and from either side") {
  const auto near = triangle({0, 0, 1}, {10, 0, 1}, {0, 10, 1}, red);
  const auto far = triangle({0, 0, 0}, {0, 10, 0}, {10, 0, 0}, blue);
  raster_scene scene;
  scene.triangles = {near, far};
  CHECK(is_shade_of(render(scene, plane_view(10), 10, 10, 1).at(2, 7), red));
  scene.triangles = {far, near};
  CHECK(is_shade_of(render(scene, plane_view(10), 10, 10, 1).at(2, 7), red));
  raster_view behind = plane_view(10);
  behind.towards = {0, 0, -1};
  CHECK(is_shade_of(render(scene, behind, 10, 10, 1).at(2, 7), blue));
}

TEST_CASE("neighbours leave no gap") {
  raster_scene scene;
  scene.triangles = {triangle({0, 0, 0}, {10, 0, 0}, {3.3, 4.7, 0}, red),
                     triangle({10, 0, 0}, {10, 10, 0}, {3.3, 4.7, 0}, red),
                     triangle({10, 10, 0}, {0, 10, 0}, {3.3, 4.7, 0}, red),
                     triangle({0, 10, 0}, {0, 0, 0}, {3.3, 4.7, 0}, red)};
  const raster_image image = render(scene, plane_view(10), 40, 40, 1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      REQUIRE(image.at(x, y) != white);
}

TEST_CASE("several samples a pixel make edges smooth") {
  raster_scene scene;
  scene.triangles = {triangle({0, 0, 0}, {4.5, 0, 0}, {4.5, 10, 0}, blue),
                     triangle({0, 0, 0}, {4.5, 10, 0}, {0, 10, 0}, blue)};
  const raster_image image = render(scene, plane_view(10), 10, 10, 4);
  const int inside = image.at(2, 5).red;
  const int edge = image.at(4, 5).red;
  CHECK(inside == 0);
  CHECK(edge == doctest::Approx(128).epsilon(0.02));
  CHECK(image.at(6, 5) == white);
}

TEST_CASE("a line is as wide as it says, before the triangle it lies on, and hidden by what is before it") {
  raster_scene scene;
  scene.triangles = {triangle({0, 0, 0}, {20, 0, 0}, {0, 20, 0}, red)};
  scene.lines = {{{vec3{0, 5, 0}, vec3{10, 5, 0}}, blue, 2}};
  const raster_image image = render(scene, plane_view(10), 10, 10, 1);
  int coloured = 0;
  for (int y = 0; y < 10; ++y)
    coloured += image.at(5, y) == blue;
  CHECK(coloured == 2);
  scene.triangles.push_back(triangle({0, 0, 1}, {20, 0, 1}, {0, 20, 1}, red));
  CHECK(is_shade_of(render(scene, plane_view(10), 10, 10, 1).at(5, 5), red));
}

TEST_CASE("of lines at one place that of the highest rank is seen, in either order") {
  const raster_line low{{vec3{0, 5, 0}, vec3{10, 5, 0}}, red, 2, 0.4},
      high{{vec3{10, 5, 0}, vec3{0, 5, 0}}, blue, 2, 0.5};
  raster_scene scene;
  for (const auto& lines : {std::vector{low, high}, std::vector{high, low}}) {
    scene.lines = lines;
    CHECK(render(scene, plane_view(10), 10, 10, 1).at(5, 5) == blue);
  }
}

TEST_CASE("a fitted view shows the whole scene") {
  raster_scene scene;
  scene.background = black;
  scene.triangles = {triangle({100, 3, -7}, {160, 5, 1}, {110, 50, 20}, red)};
  const raster_view view = fitted(view_from({1, -1, 0.8}), scene, 60, 40);
  CHECK(norm(view.right) == doctest::Approx(1));
  CHECK(dot(view.right, view.up) == doctest::Approx(0));
  CHECK(view.up.z > 0.5);
  const raster_image image = render(scene, view, 60, 40, 1);
  int coloured = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const bool border = x == 0 || y == 0 || x == 59 || y == 39;
      if (image.at(x, y) == black)
        continue;
      ++coloured;
      CHECK_FALSE(border);
    }
  CHECK(coloured > 100);
}

TEST_CASE("impossible pictures are refused") {
  CHECK_THROWS_AS(raster_image(0, 5), usage_error);
  CHECK_THROWS_AS(render({}, {}, 5, 5, 0), usage_error);
  CHECK(render({}, {}, 5, 5).at(2, 2) == white);
}

} // namespace
} // namespace dovetail::app
