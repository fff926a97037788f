#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/sizing/automatic.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/graded.hpp"
#include "dovetail/sizing/prediction.hpp"
#include "dovetail/sizing/surface_samples.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

using namespace dovetail;

namespace {

implicit_model make(const auto& body, double half) {
  return {body, {{-half, -half, -half}, {half, half, half}}, {.resolution = 32}};
}

/// A plate 2 x 2 x 0.3 with rounded rim.
implicit_model plate() {
  return {implicit::rounded_box{.half_widths = {1, 1, 0.15}, .rounding = 0.12},
          {{-1.2, -1.2, -0.4}, {1.2, 1.2, 0.4}},
          {.resolution = 72}};
}

/// On the unit square, so thick at x = 0 and at x = 1.
discrete_model wedge(double thick, double thick_at_one) {
  const std::vector<vec3> points{{0, 0, 0},     {1, 0, 0},           {0, 1, 0},
                                 {1, 1, 0},     {0, 0, thick},       {1, 0, thick_at_one},
                                 {0, 1, thick}, {1, 1, thick_at_one}};
  return {points,
          {{0, 2, 3},
           {0, 3, 1},
           {4, 5, 7},
           {4, 7, 6},
           {0, 1, 5},
           {0, 5, 4},
           {2, 6, 7},
           {2, 7, 3},
           {0, 4, 6},
           {0, 6, 2},
           {1, 3, 7},
           {1, 7, 5}}};
}

discrete_model sheet(double thick) {
  return wedge(thick, thick);
}

/// The unit cube as two solids: a layer of the given thickness on top of the rest. The normals of the square
/// between them point up, into the layer.
discrete_model cube_with_layer(double thick) {
  oriented_surfaces s;
  for (const double z : {0.0, 1 - thick, 1.0})
    for (const vec2 p : {vec2{0, 0}, vec2{1, 0}, vec2{1, 1}, vec2{0, 1}})
      s.mesh.points.push_back({p.x, p.y, z});
  const auto add = [&](std::array<local_id, 4> quad, local_id behind, local_id in_front) {
    for (const simplex<2> t :
         {simplex<2>{quad[0], quad[1], quad[2]}, simplex<2>{quad[0], quad[2], quad[3]}}) {
      s.mesh.elements.push_back(t);
      s.groups.push_back(no_id);
      s.solid_of.push_back(behind);
      s.front_of.push_back(in_front);
    }
  };
  add({0, 3, 2, 1}, 0, no_id);
  add({4, 5, 6, 7}, 0, 1);
  add({8, 9, 10, 11}, 1, no_id);
  for (local_id k = 0; k < 4; ++k)
    for (local_id layer = 0; layer < 2; ++layer) {
      const local_id a = 4 * layer + k, b = 4 * layer + (k + 1) % 4;
      add({a, b, b + 4, a + 4}, layer, no_id);
    }
  s.solids = 2;
  return discrete_model(s);
}

/// The error of doctest's own epsilon is relative to the value plus one.
doctest::Approx relative(double value, double error) {
  return doctest::Approx(value).epsilon(error).scale(0);
}

/// A size between samples: they are at most two sizes apart, and sizes grow by a quarter of the distance.
doctest::Approx near_to(double size) {
  return relative(size, 0.25);
}

constexpr std::array<vec2, 5> places{{{0.5, 0.5}, {0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}}};

} // namespace

static_assert(bounded_below_sizing_field<point_sizes>);

TEST_CASE("sizes at points grow away from them, up to the largest") {
  const point_sizes h({{{0, 0, 0}, 0.1}, {{1, 0, 0}, 0.2}}, 0.5, 0.4);
  CHECK(h({0, 0, 0}) == doctest::Approx(0.1));
  CHECK(h({0, 0.2, 0}) == doctest::Approx(0.2));
  CHECK(h({0, 5, 0}) == doctest::Approx(0.4));
  CHECK(h({1, 0, 0.1}) == doctest::Approx(0.25));
  CHECK(h.smallest_size_in({{0.1, 0, 0}, {0.2, 0, 0}}) == doctest::Approx(0.15));
  CHECK(h.smallest_size_in({{-9, -9, -9}, {9, 9, 9}}) == doctest::Approx(0.1));
}

TEST_CASE("dropping covered points changes nothing") {
  std::vector<sized_point> points;
  std::uint64_t bits = 7;
  const auto unit = [&] {
    bits = bits * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(bits >> 11) / 9007199254740992.0;
  };
  for (int i = 0; i < 2000; ++i)
    points.push_back({{unit(), unit(), unit()}, 0.01 + 0.3 * unit() * unit()});
  const point_sizes h(points, 0.3, 0.5);
  CHECK(h.size() < points.size());
  for (int i = 0; i < 500; ++i) {
    const vec3 p{unit(), unit(), unit()};
    double exact = 0.5;
    for (const sized_point& s : points)
      exact = std::min(exact, s.size + 0.3 * distance(s.point, p));
    CHECK(h(p) == relative(exact, 1e-12));
  }
}

TEST_CASE("curvature puts the elements asked for around a sphere") {
  const auto h = curvature_size(make(implicit::sphere{}, 1.3), {.elements_per_circle = 40});
  for (const vec3 p : {vec3{1, 0, 0}, vec3{0, -1, 0}, vec3{0.6, 0, 0.8}})
    CHECK(h(p) == relative(2 * std::numbers::pi / 40, 0.15));
}

TEST_CASE("curvature of a torus is that of its tube") {
  const auto h = curvature_size(make(implicit::torus{.large_radius = 1, .small_radius = 0.25}, 1.4),
                                {.elements_per_circle = 16, .range = {.largest = 0.5}});
  CHECK(h({1.25, 0, 0}) == relative(2 * std::numbers::pi * 0.25 / 16, 0.15));
  CHECK(h({0, 0, 0}) > h({0.75, 0, 0}) + 0.1); // grows away from the surface
}

TEST_CASE("proximity puts the elements asked for across a plate") {
  const auto model = plate();
  const auto one = proximity_size(model, {.elements = 1, .range = {.smallest = 0.02, .largest = 0.5}});
  const auto three = proximity_size(model, {.elements = 3, .range = {.smallest = 0.02, .largest = 0.5}});
  for (const vec3 p : {vec3{0, 0, 0.15}, vec3{0.5, -0.3, -0.15}, vec3{-0.6, 0.6, 0.15}}) {
    CHECK(one(p) == near_to(0.3));
    CHECK(three(p) == near_to(0.1));
  }
}

TEST_CASE("a gap between two bodies counts outside, not inside") {
  const auto bodies = implicit::united(implicit::rounded_box{{-0.6, 0, 0}, {0.5, 0.5, 0.5}, 0.2},
                                       implicit::rounded_box{{0.6, 0, 0}, {0.5, 0.5, 0.5}, 0.2}, 0.01);
  const implicit_model model(bodies, {{-1.3, -0.8, -0.8}, {1.3, 0.8, 0.8}}, {.resolution = 72});
  const model_size_range range{.smallest = 0.02, .largest = 0.4};
  const auto around =
      proximity_size(model, {.elements = 2, .inside = false, .outside = true, .range = range});
  const auto through =
      proximity_size(model, {.elements = 2, .inside = true, .outside = false, .range = range});
  CHECK(around({0.1, 0, 0}) == near_to(0.1));
  CHECK(through({0.1, 0, 0}) > 0.35); // a body is 1 wide
}

TEST_CASE("a layer between two solids is a wall, whichever way its faces are turned") {
  const auto h =
      proximity_size(cube_with_layer(0.1), {.elements = 2, .range = {.smallest = 0.01, .largest = 0.5}});
  for (const vec2 p : places)
    for (const double z : {1.0, 0.9}) {
      CAPTURE(p.x);
      CHECK(h({p.x, p.y, z}) == near_to(0.05));
    }
  CHECK(h({0.5, 0.5, 0}) > 0.2); // the rest is 0.9 wide
}

TEST_CASE("a thin wall gets twice its thickness, where so small a size is allowed") {
  const model_size_range range{.smallest = 0.02, .largest = 0.2};
  const auto size_in = [&](double thick, double least) {
    return proximity_size(sheet(thick), {.least_in_walls = least, .range = range});
  };
  for (const vec2 p : places) {
    const vec3 on_top{p.x, p.y, 0.006}, on_bottom{p.x, p.y, 0};
    CHECK(size_in(0.006, 0)(on_bottom) == near_to(0.02));
    for (const vec3 at : {on_top, on_bottom})
      CHECK(size_in(0.006, 0.001)(at) == near_to(0.012));
    CHECK(size_in(0.006, 0.013)(on_bottom) == near_to(0.02)); // given up
    CHECK(size_in(0.03, 0.001)(on_bottom) == near_to(0.02));
    CHECK(size_in(0.06, 0.001)(on_bottom) == near_to(0.03));
  }
}

TEST_CASE("a thin wall gets no smaller size than was asked for") {
  for (const double thick : {0.009, 0.004}) {
    const auto h = proximity_size(
        sheet(thick),
        {.elements = 0.2, .least_in_walls = 0.001, .range = {.smallest = 0.02, .largest = 0.2}});
    CHECK(h({0.5, 0.5, 0}) == near_to(5 * thick));
  }
}

TEST_CASE("where more samples were needed than are taken walls are still found all over") {
  // Faces of 1 x 1 on a slanted sheet, sampled at other places on top than below.
  const auto h = proximity_size(wedge(0.0004, 0.0005),
                                {.least_in_walls = 1e-5, .range = {.smallest = 0.02, .largest = 0.2}});
  for (double x = 0.03; x < 1; x += 0.047)
    for (double y = 0.03; y < 1; y += 0.083) {
      CAPTURE(x);
      CAPTURE(y);
      CHECK(h({x, y, 0}) < 0.006);
    }
}

TEST_CASE("towards an edge where its faces meet a wall is not followed") {
  const auto h =
      proximity_size(wedge(0.1, 0), {.least_in_walls = 0.001, .range = {.smallest = 0.04, .largest = 0.2}});
  for (double x = 0; x <= 1; x += 0.05)
    CHECK(h({x, 0.5, 0}) >= 0.04);
}

TEST_CASE("of automatic sizes the thinnest walls are given up, and others made less small") {
  constexpr model_size_range range{.smallest = 0.02, .largest = 0.2};
  const automatic_points points(sheet(0.006), {.least_in_walls = 1e-4, .range = range});
  CHECK(points.has_thin_walls());
  const auto size_with = [&](const thin_wall_sizes& walls) {
    return points.field(walls).field()({0.5, 0.5, 0});
  };
  CHECK(size_with({}) == near_to(0.012));
  CHECK(size_with({.factor = 1.5}) == near_to(0.018));
  CHECK(size_with({.factor = 1.5, .least = 0.0181}) >= 0.02);
  CHECK(!automatic_points(sheet(0.006), {.range = range}).has_thin_walls());
}

TEST_CASE("how small sizes in walls are follows from how many elements they may add") {
  // A sheet of one layer, three tetrahedra for each of its prisms, with triangles of the size and of 0.02.
  const automatic_points points(sheet(0.006),
                                {.least_in_walls = 1e-4, .range = {.smallest = 0.02, .largest = 0.2}});
  const auto added = [](double size) {
    return 3 * elements_per_unit<2> * (1 / (size * size) - 1 / (0.02 * 0.02));
  };
  CHECK(points.elements_in_walls() == relative(added(0.012), 0.1));
  CHECK(points.elements_in_walls({.factor = 1.5}) == relative(added(0.018), 0.1));
  CHECK(points.elements_in_walls({.factor = 1, .least = 0.0121}) == 0);

  CHECK(points.walls_within(1e6).factor == 1);
  CHECK(points.walls_within(1e6).least == 0);
  const auto somewhat_larger = points.walls_within(0.7 * points.elements_in_walls());
  CHECK(somewhat_larger.factor == relative(std::sqrt(1 / 0.7), 1e-6));
  CHECK(somewhat_larger.least == 0);
  for (const double elements : {100.0, 0.0, -1e6}) {
    CAPTURE(elements);
    const auto given_up = points.walls_within(elements); // as a whole
    CHECK(points.elements_in_walls(given_up) == 0);
    CHECK(points.field(given_up).field()({0.3, 0.7, 0}) >= 0.02);
  }
}

TEST_CASE("of a wall that gets thinner only the thin part is given up") {
  const automatic_points points(wedge(0.0035, 0.0095),
                                {.least_in_walls = 1e-4, .range = {.smallest = 0.02, .largest = 0.2}});
  const auto walls = points.walls_within(0.1 * points.elements_in_walls());
  const auto h = points.field(walls);
  CHECK(walls.least > 0);
  CHECK(h.field()({0.02, 0.5, 0}) > 0.018);
  CHECK(h.field()({0.5, 0.5, 0}) == near_to(1.5 * 2 * 0.0065));
}

TEST_CASE("where sampling meets its limit no part of a face is without samples") {
  const auto everywhere = [](const sizing::surface_sample&) { return 1e-4; };
  const auto samples = sizing::sample_surface(sheet(0.5), everywhere, {.per_face = 500});
  for (const vec2 p : places) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& s : samples)
      if (s.normal.z > 0.5)
        nearest = std::min(nearest, norm(vec2{s.point.x - p.x, s.point.y - p.y}));
    CHECK(nearest < 0.06); // 500 are 0.045 apart
  }
}

TEST_CASE("automatic sizes are the smallest of both, and deterministic") {
  const auto model = plate();
  const automatic_options options{
      .elements_per_circle = 24, .elements_across = 2, .range = {.smallest = 0.02, .largest = 0.5}};
  const auto h = automatic_size(model, options);
  const auto again = automatic_size(model, options);
  const auto curved = curvature_size(model, {.elements_per_circle = 24, .range = options.range});
  const auto near = proximity_size(model, {.elements = 2, .range = options.range});
  for (double x = -1.1; x < 1.2; x += 0.13) {
    const vec3 p{x, 0.37 * x, 0.15};
    CHECK(h(p) == again(p));
    CHECK(h.field()(p) == doctest::Approx(std::min(curved(p), near(p))).epsilon(1e-12));
  }
}

TEST_CASE("user lambdas are fields, and all fields combine") {
  const auto model = make(implicit::sphere{}, 1.3);
  const auto wave = [](vec3 p) { return 0.2 + 0.1 * std::sin(p.x); };
  static_assert(sizing_field<decltype(wave)>);
  // part limited
  const auto automatic = automatic_size(model, {.range = {.largest = 0.5}}); // by curvature and walls
  const minimum_of both(automatic, wave);                                    // of any fields
  const bounded limited(scaled(both, 2), 0.1, 0.45);
  const graded_size smooth(limited, model.bounds(), {.slope = 0.2}); // growing by 0.2 per length at most
  // end
  for (const vec3 p : {vec3{}, vec3{1, 0, 0}, vec3{0, 0.5, 0.5}}) {
    CHECK(both(p) == std::min(automatic(p), wave(p)));
    CHECK(limited(p) == std::clamp(2 * both(p), 0.1, 0.45));
    CHECK(smooth(p) <= 1.1 * limited(p));
  }
}

TEST_CASE("options out of range are typed errors") {
  const auto model = make(implicit::sphere{}, 1.3);
  CHECK_THROWS_AS(curvature_size(model, {.elements_per_circle = 0}), sizing_error);
  CHECK_THROWS_AS(proximity_size(model, {.elements = -1}), sizing_error);
  CHECK_THROWS_AS(proximity_size(model, {.least_in_walls = -1}), sizing_error);
  CHECK_THROWS_AS(automatic_size(model, {.range = {.smallest = 2, .largest = 1}}), sizing_error);
  CHECK_THROWS_AS(automatic_size(model, {.range = {.growth = 0}}), sizing_error);
}
