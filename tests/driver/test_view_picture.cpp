#include "view_picture.hpp"

#include "colours.hpp"
#include "view_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace dovetail::app {
namespace {

constexpr rgb colour_inside{214, 208, 196};

/// Seen along y, the row lies from left to right.
view_wishes from_front(view_colours colours) {
  view_wishes wishes;
  wishes.towards = {0, -1, 0};
  wishes.width = 120;
  wishes.height = 60;
  wishes.colours = colours;
  wishes.edges = false;
  return wishes;
}

/// Whether a pixel has this colour, brighter or darker.
bool is_shade_of(rgb pixel, rgb colour) {
  const double factor =
      static_cast<double>(pixel.red + pixel.green + pixel.blue) / (colour.red + colour.green + colour.blue);
  const auto agrees = [&](int found, int wanted) { return std::abs(found - factor * wanted) < 2.5; };
  return agrees(pixel.red, colour.red) && agrees(pixel.green, colour.green) &&
         agrees(pixel.blue, colour.blue);
}

int sum_of(rgb pixel) {
  return pixel.red + pixel.green + pixel.blue;
}

int pixels_unlike_background(const raster_image& image) {
  return static_cast<int>(std::count_if(image.data(), image.data() + image.width() * image.height(),
                                        [](rgb pixel) { return pixel != white; }));
}

TEST_CASE("corners have the background, the middle the colours of pieces") {
  const view_scene scene = scene_of(testing::cubes_in_pieces(2));
  const raster_image image = picture_of_view(scene, from_front(view_colours::piece));
  for (const int x : {0, 119})
    for (const int y : {0, 59})
      CHECK(image.at(x, y) == white);
  CHECK(is_shade_of(image.at(30, 30), colour_of_number(0)));
  CHECK(is_shade_of(image.at(90, 30), colour_of_number(1)));
  CHECK_FALSE(is_shade_of(image.at(90, 30), colour_of_number(0)));
}

TEST_CASE("groups and angles are colours too") {
  const view_scene scene = scene_of(testing::two_squares());
  view_wishes wishes = from_front(view_colours::group);
  wishes.towards = direction_to_viewer(scene.box);
  CHECK(wishes.towards == vec3{0, 0, 1});
  raster_image image = picture_of_view(scene, wishes);
  CHECK(is_shade_of(image.at(30, 30), colour_of_number(0)));
  CHECK(is_shade_of(image.at(90, 30), colour_of_number(1)));
  wishes.colours = view_colours::angle;
  image = picture_of_view(scene, wishes);
  CHECK(is_shade_of(image.at(30, 30), colour_of_angle(45)));
  CHECK(colour_of_angle(0) == rgb{190, 20, 40});
  CHECK(colour_of_angle(180) == colour_of_angle(70));
}

TEST_CASE("a section shows elements inside, and takes away what is before it") {
  const view_scene scene = scene_of(testing::row_of_cubes(2));
  view_wishes wishes = from_front(view_colours::group);
  CHECK_FALSE(is_shade_of(picture_of_view(scene, wishes).at(40, 35), colour_inside));
  wishes.cut = view_plane{{0, -1, 0}, -0.5};
  CHECK(is_shade_of(picture_of_view(scene, wishes).at(40, 35), colour_inside));
  wishes.cut = view_plane{{1, 0, 0}, 1}; // half of the row stays, and fills the picture
  const raster_image half = picture_of_view(scene, wishes);
  CHECK(half.at(20, 30) == white);
  CHECK(half.at(100, 30) == white);
  CHECK(half.at(60, 30) != white);
  wishes.cut = view_plane{{1, 0, 0}, -5}; // nothing stays
  CHECK(pixels_unlike_background(picture_of_view(scene, wishes)) == 0);
}

TEST_CASE("elements are drawn from an angle on; of none there is the outline") {
  const view_scene scene = scene_of(testing::row_of_cubes(2));
  view_wishes wishes = from_front(view_colours::angle);
  wishes.under = 46;
  CHECK(elements_under(scene, 46) == 12);
  CHECK(is_shade_of(picture_of_view(scene, wishes).at(40, 35), colour_of_angle(45)));
  wishes.under = 44;
  CHECK(elements_under(scene, 44) == 0);
  const raster_image none = picture_of_view(scene, wishes);
  // The body is pale, and all of it there; elements are seen before it, wherever they are.
  for (const int x : {8, 40, 80, 112}) {
    CHECK(none.at(x, 35) != white);
    CHECK(sum_of(none.at(x, 35)) > 3 * 190);
  }
  CHECK(none.at(1, 1) == white);
  wishes.under = 46;
  CHECK(is_shade_of(picture_of_view(scene, wishes).at(40, 35), colour_of_angle(45)));
}

TEST_CASE("a picture of elements alone is as large as the body around them, edges or not") {
  view_scene scene = scene_of(testing::row_of_cubes(2));
  scene.outline.clear(); // as of a ball
  view_wishes wishes = from_front(view_colours::angle);
  wishes.under = 44;
  CHECK(pixels_unlike_background(picture_of_view(scene, wishes)) > 4000);
}

TEST_CASE("it is known where colours are of angles") {
  view_wishes wishes;
  CHECK_FALSE(shows_angles(wishes));
  wishes.under = 20;
  CHECK(shows_angles(wishes)); // and not of groups
  wishes.colours = view_colours::piece;
  CHECK_FALSE(shows_angles(wishes));
  wishes = {.colours = view_colours::angle};
  CHECK(shows_angles(wishes));
  CHECK(text_of_angle_colours().starts_with("0° dark red, 10° red, "));
  CHECK(text_of_angle_colours().ends_with("70° blue (and above)"));
}

TEST_CASE("pieces are pulled apart") {
  const view_scene scene = scene_of(testing::cubes_in_pieces(2));
  view_wishes wishes = from_front(view_colours::piece);
  CHECK(picture_of_view(scene, wishes).at(57, 30) != white);
  wishes.explode = 1;
  const raster_image apart = picture_of_view(scene, wishes);
  CHECK(apart.at(57, 30) == white);
  CHECK(apart.at(63, 30) == white);
  CHECK(is_shade_of(apart.at(25, 30), colour_of_number(0)));
  CHECK(is_shade_of(apart.at(95, 30), colour_of_number(1)));
}

/// n x n squares of two triangles each.
io::loaded_mesh flat_grid(local_id n) {
  io::loaded_mesh grid;
  for (local_id y = 0; y <= n; ++y)
    for (local_id x = 0; x <= n; ++x)
      grid.mesh.points.push_back({static_cast<double>(x), static_cast<double>(y), 0});
  for (local_id y = 0; y < n; ++y)
    for (local_id x = 0; x < n; ++x) {
      const local_id v = y * (n + 1) + x;
      grid.triangles.push_back({v, v + 1, v + n + 2});
      grid.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return grid;
}

TEST_CASE("edges are dark where they are long enough to be seen") {
  const view_scene scene = scene_of(testing::row_of_cubes(2));
  view_wishes wishes = from_front(view_colours::group);
  const auto darkest = [&] {
    const raster_image image = picture_of_view(scene, wishes);
    int sum = 3 * 255;
    for (int x = 10; x < 55; ++x) // a row that crosses the diagonal of a square
      sum = std::min(sum, sum_of(image.at(x, 25)));
    return sum;
  };
  const int without = darkest();
  wishes.edges = true;
  CHECK(darkest() < 0.85 * without);
}

TEST_CASE("no element loses single edges, however short") {
  io::loaded_mesh rhombus; // of two triangles, 110 pixels wide; what is between them has four
  rhombus.mesh.points = {{-10, 0, 0}, {0, -0.4, 0}, {10, 0, 0}, {0, 0.4, 0}};
  rhombus.triangles = {{0, 1, 3}, {1, 2, 3}};
  const auto is_darker = [](const view_scene& scene, view_wishes wishes, int x, int y) {
    const raster_image without = picture_of_view(scene, wishes);
    wishes.edges = true;
    return sum_of(picture_of_view(scene, wishes).at(x, y)) < 0.85 * sum_of(without.at(x, y));
  };
  view_wishes wishes = from_front(view_colours::group);
  wishes.towards = {0, 0, 1};
  CHECK(is_darker(scene_of(std::move(rhombus)), wishes, 60, 29));
  CHECK_FALSE(is_darker(scene_of(testing::two_squares()), wishes, 70, 20));

  // A section at y = 0.07 meets the elements of a cube along x = y, z = y and x = z.
  wishes.towards = {0, -1, 0};
  wishes.cut = view_plane{{0, -1, 0}, -0.07};
  const view_scene row = scene_of(testing::row_of_cubes(2));
  CHECK(is_darker(row, wishes, 63, 56));
  CHECK_FALSE(is_darker(row, wishes, 66, 56));
}

TEST_CASE("edges fade with the size of elements, without a jump") {
  const view_scene scene = scene_of(flat_grid(12));
  const auto darkening = [&](int size) {
    view_wishes wishes = from_front(view_colours::group);
    wishes.towards = {0, 0, 1};
    wishes.width = wishes.height = size;
    const auto brightness = [&] {
      const raster_image image = picture_of_view(scene, wishes);
      return std::accumulate(image.data(), image.data() + size * size, 0.0,
                             [](double sum, rgb pixel) { return sum + sum_of(pixel); });
    };
    const double without = brightness();
    wishes.edges = true;
    return 1 - brightness() / without;
  };
  CHECK(darkening(22) == 0); // 1.7 pixels each
  CHECK(darkening(180) > 0.08);
  double before = 0;
  for (int size = 24; size <= 180; size += 4) { // up to 14 pixels
    const double now = darkening(size);
    INFO(size);
    CHECK(std::abs(now - before) < 0.03);
    before = now;
  }
}

TEST_CASE("marks are discs with a dark rim, drawn over the mesh") {
  const view_scene scene = scene_of(testing::row_of_cubes(2));
  view_wishes wishes = from_front(view_colours::piece);
  const raster_image without = picture_of_view(scene, wishes);
  constexpr rgb red{220, 40, 40}, blue{30, 100, 225};
  wishes.marks.all = {{{1, 0, 0.5}, "", red, ""}, {{1, -0.25, 0.5}, "", blue, ""}}; // one behind the other
  const raster_image with = picture_of_view(scene, wishes);
  for (const int x : {59, 60})
    for (const int y : {29, 30})
      CHECK(with.at(x, y) == red); // the first one is over the other
  CHECK(with.at(64, 30).red < 90); // the rim
  CHECK(with.at(70, 30) == without.at(70, 30));
  const auto changed = [&](const raster_image& image) {
    int count = 0;
    for (int k = 0; k < 120 * 60; ++k)
      count += image.data()[k] != without.data()[k];
    return count;
  };
  CHECK(changed(with) > 70); // of 5 pixels radius
  CHECK(changed(with) < 110);

  wishes.marks.all = {{{0, 0, 1}, "", red, ""}}; // at a corner of the mesh, a part of the disc beside it
  CHECK(changed(picture_of_view(scene, wishes)) > 60);
  wishes.marks.all = {
      {{1e308, 0, 0}, "", red, ""}, {{-1e308, 1e308, 1e308}, "", red, ""}, {{9, 9, 9}, "", red, ""}};
  CHECK(changed(picture_of_view(scene, wishes)) == 0);
}

TEST_CASE("marks behind the surface are hollow") {
  const view_scene scene = scene_of(testing::row_of_cubes(2));
  view_wishes wishes = from_front(view_colours::piece);
  const raster_image without = picture_of_view(scene, wishes);
  constexpr rgb red{220, 40, 40};
  const auto with_mark = [&](vec3 at) {
    wishes.marks.all = {{at, "", red, ""}};
    return picture_of_view(scene, wishes);
  };
  const auto is_red = [](rgb pixel) { return pixel.red > 150 && pixel.green < 80 && pixel.blue < 80; };
  for (const double depth : {0.1, 0.5, 1.0}) { // the last is on the back
    const raster_image image = with_mark({1, depth, 0.5});
    INFO(depth);
    CHECK(image.at(60, 30) == without.at(60, 30));
    CHECK(is_red(image.at(63, 30))); // the ring
  }
  CHECK(is_red(with_mark({1, 0, 0.5}).at(60, 30)));
  CHECK(is_red(with_mark({1, 0.02, 0.5}).at(60, 30))); // as good as on it
  CHECK(is_red(with_mark({1, 0, 1}).at(60, 2)));       // where the mesh ends

  // A section shows what it cuts; elements under an angle hide nothing but what is behind them.
  wishes.cut = view_plane{{0, -1, 0}, -0.5};
  CHECK(is_red(with_mark({1, 0.5, 0.5}).at(60, 30)));
  CHECK_FALSE(is_red(with_mark({1, 0.8, 0.5}).at(60, 30)));
  wishes.cut.reset();
  wishes.under = 44; // there are none
  CHECK(is_red(with_mark({1, 0.5, 0.5}).at(60, 30)));
}

TEST_CASE("marks are cut with the mesh, and not drawn where its pieces are moved away from them") {
  const view_scene scene = scene_of(testing::cubes_in_pieces(2));
  view_wishes wishes = from_front(view_colours::piece);
  constexpr rgb red{220, 40, 40};
  const auto is_marked = [&] {
    const raster_image image = picture_of_view(scene, wishes);
    view_wishes plain = wishes;
    plain.marks = {};
    const raster_image without = picture_of_view(scene, plain);
    return !std::equal(image.data(), image.data() + image.width() * image.height(), without.data());
  };
  wishes.marks.all = {{{1, 0.25, 0.5}, "", red, ""}};
  CHECK(is_marked());
  wishes.cut = view_plane{{0, -1, 0}, -0.5};
  CHECK_FALSE(is_marked());
  wishes.cut = view_plane{{0, -1, 0}, -0.125};
  CHECK(is_marked());
  wishes.cut.reset();
  wishes.explode = 1;
  CHECK_FALSE(is_marked());
}

} // namespace
} // namespace dovetail::app
