#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/sizing/automatic.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/graded.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
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
    CHECK(h(p) == doctest::Approx(exact).epsilon(1e-12));
  }
}

TEST_CASE("curvature puts the elements asked for around a sphere") {
  const auto h = curvature_size(make(implicit::sphere{}, 1.3), {.elements_per_circle = 40});
  for (const vec3 p : {vec3{1, 0, 0}, vec3{0, -1, 0}, vec3{0.6, 0, 0.8}})
    CHECK(h(p) == doctest::Approx(2 * std::numbers::pi / 40).epsilon(0.15));
}

TEST_CASE("curvature of a torus is that of its tube") {
  const auto h = curvature_size(make(implicit::torus{.large_radius = 1, .small_radius = 0.25}, 1.4),
                                {.elements_per_circle = 16, .range = {.largest = 0.5}});
  CHECK(h({1.25, 0, 0}) == doctest::Approx(2 * std::numbers::pi * 0.25 / 16).epsilon(0.15));
  CHECK(h({0, 0, 0}) > h({0.75, 0, 0}) + 0.1); // grows away from the surface
}

TEST_CASE("proximity puts the elements asked for across a plate") {
  const auto model = plate();
  const auto one = proximity_size(model, {.elements = 1, .range = {.smallest = 0.02, .largest = 0.5}});
  const auto three = proximity_size(model, {.elements = 3, .range = {.smallest = 0.02, .largest = 0.5}});
  for (const vec3 p : {vec3{0, 0, 0.15}, vec3{0.5, -0.3, -0.15}, vec3{-0.6, 0.6, 0.15}}) {
    CHECK(one(p) == doctest::Approx(0.3).epsilon(0.1));
    CHECK(three(p) == doctest::Approx(0.1).epsilon(0.1));
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
  CHECK(around({0.1, 0, 0}) == doctest::Approx(0.1).epsilon(0.1));
  CHECK(through({0.1, 0, 0}) > 0.35); // a body is 1 wide
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
  const auto automatic = automatic_size(model, {.range = {.largest = 0.5}});
  const minimum_of both(automatic, wave);
  const bounded limited(scaled(both, 2), 0.1, 0.45);
  const graded_size smooth(limited, model.bounds(), {.slope = 0.2});
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
  CHECK_THROWS_AS(automatic_size(model, {.range = {.smallest = 2, .largest = 1}}), sizing_error);
  CHECK_THROWS_AS(automatic_size(model, {.range = {.growth = 0}}), sizing_error);
}
