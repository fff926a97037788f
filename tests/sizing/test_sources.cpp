#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>

using namespace dovetail;

static_assert(sizing_field<uniform_size> && sizing_field<source_field> && sizing_field<minimum_of> &&
              sizing_field<erased_sizing> && sizing_field<any_sizing> && sizing_field<scaled<uniform_size>>);
static_assert(bounded_below_sizing_field<source_field> && bounded_below_sizing_field<bounded<erased_sizing>>);

namespace {

/// Distance to a segment by dense sampling: independent of the library's closed form.
double sampled_distance(vec3 a, vec3 b, vec3 p) {
  double best = 1e300;
  for (int i = 0; i <= 20000; ++i)
    best = std::min(best, distance(a + (i / 20000.0) * (b - a), p));
  return best;
}

std::vector<grid_source> random_sources(std::mt19937& random, int count, source_growth growth) {
  std::uniform_real_distribution<double> at(0, 10);
  std::uniform_real_distribution<double> length(0.1, 1.5);
  std::vector<grid_source> sources;
  for (int i = 0; i < count; ++i) {
    const auto point = [&] { return vec3{at(random), at(random), at(random)}; };
    grid_source s;
    s.dimension = i % 3;
    s.growth = growth;
    for (std::size_t k = 0; k < 3; ++k) {
      s.corners[k] = k == 0 ? point() : s.corners[0] + 0.2 * (point() - s.corners[0]);
      s.inner_radius[k] = length(random) * 0.3;
      s.outer_radius[k] = s.inner_radius[k] + length(random);
      s.spacing[k] = 0.05 * length(random);
    }
    sources.push_back(s);
  }
  return sources;
}

} // namespace

TEST_CASE("a point source is constant inside, geometric to its outer radius, ambient beyond") {
  const source_field h(2.0, {point_source({1, 2, 3}, 0.5, 1.5, 0.1)});
  CHECK(h({1, 2, 3}) == 0.1);
  CHECK(h({1.49, 2, 3}) == 0.1);
  CHECK(h({2.0, 2, 3}) == doctest::Approx(std::sqrt(0.1 * 2.0)));
  CHECK(h({2.5000001, 2, 3}) == 2.0);
  CHECK(h({99, 2, 3}) == 2.0);
}

TEST_CASE("the doubling law doubles at the outer radius and meets the ambient size without a jump") {
  grid_source s = point_source({0, 0, 0}, 0.5, 1.5, 0.1);
  s.growth = source_growth::doubling;
  const source_field h(0.8, {s});
  CHECK(h({0, 0.5, 0}) == 0.1);
  CHECK(h({0, 1.5, 0}) == doctest::Approx(0.2));
  CHECK(h({0, 2.5, 0}) == doctest::Approx(0.4));
  CHECK(h({0, 3.4999999, 0}) == doctest::Approx(0.8).epsilon(1e-6));
  CHECK(h({0, 3.5000001, 0}) == 0.8);
}

TEST_CASE("a line source measures the distance to its segment and mixes its ends") {
  const vec3 a{0, 0, 0};
  const vec3 b{4, 1, 0};
  const source_field h(1.0, {line_source(a, b, 0.25, 1.0, 0.01)});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-1, 5);
  for (int i = 0; i < 200; ++i) {
    const vec3 p{at(random), at(random), at(random)};
    const double r = sampled_distance(a, b, p);
    const double t = std::clamp((r - 0.25) / 0.75, 0.0, 1.0);
    CHECK(h(p) == doctest::Approx(std::pow(0.01, 1 - t)).epsilon(1e-4));
  }
  grid_source tapered = line_source(a, b, 0.25, 1.0, 0.01);
  tapered.spacing = {0.01, 0.03, 0.03};
  CHECK(source_field(1.0, {tapered})(midpoint(a, b)) == doctest::Approx(0.02));
}

TEST_CASE("a triangle source is constant on its triangle") {
  const source_field h(1.0, {triangle_source({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, 0.5, 0.02)});
  CHECK(h({0.5, 0.5, 0.05}) == 0.02);
  CHECK(h({0.5, 0.5, 0.3}) == doctest::Approx(std::sqrt(0.02)));
  CHECK(h({1.2, 1.2, 0}) > 0.02); // outside the hypotenuse by 0.28
  CHECK(h({0.5, 0.5, 0.6}) == 1.0);
}

TEST_CASE("the tree gives what a loop over the sources gives") {
  for (const auto growth : {source_growth::to_ambient, source_growth::doubling}) {
    std::mt19937 random(7);
    const auto sources = random_sources(random, 300, growth);
    const double slope = growth == source_growth::doubling ? 0.2 : 1e9;
    const source_field all(0.9, sources, slope);
    std::vector<source_field> each;
    for (const auto& s : sources)
      each.emplace_back(0.9, std::vector{s}, slope);
    std::uniform_real_distribution<double> at(-1, 11);
    int reached = 0;
    for (int i = 0; i < 2000; ++i) {
      const vec3 p{at(random), at(random), at(random)};
      double least = 0.9;
      for (const auto& one : each)
        least = std::min(least, one(p));
      reached += least < 0.9 ? 1 : 0;
      CHECK(all(p) == doctest::Approx(least).epsilon(1e-12));
    }
    CHECK(reached > 500);
  }
}

TEST_CASE("a slope limit makes the growth exponential, then straight, and keeps the bounds true") {
  const double slope = 0.25;
  // Straight at once, further out, and never.
  for (const double outer : {0.5001, 1.5, 4.5, 40.0}) {
    const source_field free(2.0, {point_source({0, 0, 0}, 0.5, outer, 0.1)});
    const source_field limited(2.0, {point_source({0, 0, 0}, 0.5, outer, 0.1)}, slope);
    std::vector<double> radii;
    for (int i = 0; i <= 4000; ++i)
      radii.push_back(0.01 * i);
    for (int i = 0; i < 4000; i += 37) {
      double exact =
          2.0; // min over y of h(y) + slope |x - y| along the ray, which passes the source's centre
      const double r = 0.01 * i;
      for (const double y : radii)
        exact = std::min(exact, free({y, 0, 0}) + slope * std::abs(r - y));
      CHECK(limited({r, 0, 0}) == doctest::Approx(exact).epsilon(0.003));
    }
  }
  CHECK_THROWS_AS(source_field(1, {}, 0), sizing_error);
  CHECK_THROWS_AS(source_field(1, {}, std::nan("")), sizing_error);
}

TEST_CASE("smallest_size_in is a lower bound and gets sharp") {
  for (const auto growth : {source_growth::to_ambient, source_growth::doubling})
    for (const double slope : {0.25, std::numeric_limits<double>::infinity()}) {
      std::mt19937 random(11);
      const source_field h(0.9, random_sources(random, 100, growth), slope);
      std::uniform_real_distribution<double> at(0, 10);
      std::uniform_real_distribution<double> unit(0, 1);
      for (int i = 0; i < 300; ++i) {
        const vec3 corner{at(random), at(random), at(random)};
        const vec3 extent{2 * unit(random), 2 * unit(random), 2 * unit(random)};
        const box3 box{corner, corner + extent};
        const double bound = h.smallest_size_in(box);
        CHECK(bound > 0);
        for (int j = 0; j < 50; ++j) {
          const vec3 p{corner.x + unit(random) * extent.x, corner.y + unit(random) * extent.y,
                       corner.z + unit(random) * extent.z};
          CHECK(h(p) >= bound * (1 - 1e-9));
        }
        const vec3 tiny{1e-7, 1e-7, 1e-7};
        CHECK(h.smallest_size_in({corner - tiny, corner + tiny}) == doctest::Approx(h(corner)).epsilon(1e-4));
      }
    }
}

TEST_CASE("the field of a box is the whole one there, to the last bit, and goes on as that outside") {
  for (const auto growth : {source_growth::to_ambient, source_growth::doubling})
    for (const double slope : {0.25, std::numeric_limits<double>::infinity()}) {
      std::mt19937 random(13);
      const source_field whole(0.9, random_sources(random, 300, growth), slope);
      std::uniform_real_distribution<double> at(0, 10), unit(0, 1);
      std::size_t most = 0;
      for (int i = 0; i < 50; ++i) {
        const vec3 corner{at(random), at(random), at(random)},
            extent{unit(random), unit(random), unit(random)};
        const box3 box{corner, corner + extent};
        const source_field part = whole.within(box);
        const any_sizing faster = faster_in(keep_bounds(whole), box);
        most = std::max(most, part.sources().size());
        for (int j = 0; j < 100; ++j) {
          vec3 inside = corner;
          for (int k = 0; k < 3; ++k)
            inside[k] += unit(random) * extent[k];
          CHECK(part(inside) == whole(inside));
          CHECK(faster(inside) == whole(inside));
          const vec3 anywhere{at(random), at(random), at(random)};
          CHECK(faster(anywhere) == whole(anywhere));
        }
        CHECK(smallest_size_in(faster, box) == whole.smallest_size_in(box));
        CHECK(feature_size(faster, corner) == whole.feature_size(corner));
      }
      CHECK(most < 150);
    }
  const any_sizing plain = [](vec3 p) { return 1 + p.x; };
  CHECK(faster_in(plain, {{0, 0, 0}, {1, 1, 1}})({0.5, 0, 0}) == 1.5);
}

TEST_CASE("feature_size is half the inner radius or distance of the sources in reach") {
  const source_field h(2.0, {point_source({0, 0, 0}, 0.5, 1.5, 0.1), point_source({1, 0, 0}, 0, 0.6, 0.1)});
  CHECK(h.feature_size({-0.2, 0, 0}) == 0.25);
  CHECK(h.feature_size({-1, 0, 0}) == 0.5);
  CHECK(h.feature_size({0.9, 0, 0}) == doctest::Approx(0.05));
  CHECK(std::isinf(h.feature_size({5, 0, 0})));
  CHECK(feature_size(keep_bounds(minimum_of(uniform_size(1), scaled(h, 2.0))), {-1, 0, 0}) == 0.5);
}

TEST_CASE("values out of range are refused with the source's name") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double wrong : {0.0, -1.0, nan, inf}) {
    CHECK_THROWS_AS(uniform_size{wrong}, sizing_error);
    CHECK_THROWS_AS(source_field(wrong, {}), sizing_error);
    CHECK_THROWS_AS(source_field(1, {point_source({}, 1, 2, wrong)}), sizing_error);
    CHECK_THROWS_AS(source_field(1, {point_source({}, 0, wrong, 1)}), sizing_error);
    CHECK_THROWS_AS(scaled(uniform_size(1), wrong), sizing_error);
    CHECK_THROWS_AS(bounded(uniform_size(1), wrong, 2), sizing_error);
  }
  CHECK_THROWS_AS(source_field(1, {point_source({nan, 0, 0}, 1, 2, 1)}), sizing_error);
  CHECK_THROWS_AS(source_field(1, {point_source({}, 3, 2, 1)}), sizing_error);
  CHECK_THROWS_AS(bounded(uniform_size(1), 3, 2), sizing_error);
  CHECK_THROWS_AS(minimum_of(std::vector<erased_sizing>{}), sizing_error);
  grid_source named = point_source({}, 0, 1, -1);
  named.name = "leading edge";
  CHECK_THROWS_WITH_AS(source_field(1, {point_source({}, 0, 1, 1), named}),
                       doctest::Contains("source 1 (leading edge)"), sizing_error);
}

TEST_CASE("compositions evaluate and keep their bounds") {
  const source_field sources(2.0, {point_source({0, 0, 0}, 0.5, 1.5, 0.1)});
  const minimum_of least(sources, uniform_size(1.0));
  const bounded clamped(scaled(least, 3.0), 0.4, 10.0);
  CHECK(least({0, 0, 0}) == 0.1);
  CHECK(least({9, 0, 0}) == 1.0);
  CHECK(clamped({0, 0, 0}) == 0.4);
  CHECK(clamped({9, 0, 0}) == 3.0);
  const box3 far{{8, 8, 8}, {9, 9, 9}};
  CHECK(clamped.smallest_size_in(far) == 3.0);
  const any_sizing run_time = keep_bounds(least);
  CHECK(smallest_size_in(run_time, far) == 1.0);
  CHECK(erased_sizing(run_time).smallest_size_in(far) == 1.0);
  const any_sizing lambda = [](vec3 p) { return 1 + norm(p); };
  CHECK(smallest_size_in(lambda, far) == 0.0);
  CHECK(minimum_of(lambda, sources).smallest_size_in(far) == 0.0);
}

TEST_CASE("sources that all reach each other are searched and not gone through one by one") {
  // A hundred thousand times a hundred thousand would take minutes.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto anywhere = [&] { return vec3{uniform(random), uniform(random), uniform(random)}; };
  constexpr std::size_t many = 100'000;
  std::vector<grid_source> sources;
  for (std::size_t i = 0; i < many; ++i)
    sources.push_back(point_source(anywhere(), 1e-3, 5, 0.1));
  const source_field field(10, sources);
  const vec3 low{0.4, 0.4, 0.4}, high{0.6, 0.6, 0.6};
  std::vector<double> least(3, 1e300);
  for (std::size_t i = 0; i < many; ++i) {
    const vec3 p = anywhere();
    least[0] = std::min(least[0], field(p));
    least[1] = std::min(least[1], field.feature_size(p));
    least[2] = std::min(least[2], field.smallest_size_in({p, p + vec3{1e-4, 1e-4, 1e-4}}));
  }
  CHECK(least[0] == 0.1);
  CHECK(least[1] == 5e-4);
  CHECK(least[2] == doctest::Approx(0.1));
  CHECK(field.smallest_size_in({low, high}) == doctest::Approx(0.1));
}

TEST_CASE("where long lists of sources are searched the size is that of a loop to the last bit") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto anywhere = [&] { return vec3{uniform(random), uniform(random), uniform(random)}; };
  for (const double slope : {std::numeric_limits<double>::infinity(), 0.4}) {
    std::vector<grid_source> sources;
    for (int i = 0; i < 900; ++i) {
      const double factor = 1 + (i % 4 == 0 ? 0.0 : uniform(random)); // some have the same spacing
      grid_source s = point_source(anywhere(), 0.02 * factor, 3 * factor, 0.05 * factor);
      if (i % 3 == 1)
        s = line_source(s.corners[0], anywhere(), 0.02, 2, 0.06 * factor);
      if (i % 3 == 2) {
        s = triangle_source(s.corners[0], anywhere(), anywhere(), 0.01, 2, 0.1);
        s.spacing[1] = 0.1 * factor;
        s.outer_radius[2] = 2 * factor;
      }
      if (i % 5 == 0)
        s.growth = source_growth::doubling;
      sources.push_back(s);
    }
    const source_field field(3, sources, slope);
    std::vector<source_field> alone;
    for (const grid_source& s : sources)
      alone.emplace_back(3, std::vector{s}, slope);
    for (int i = 0; i < 400; ++i) {
      const vec3 p = 2.0 * anywhere() - vec3{0.5, 0.5, 0.5};
      const box3 box{p, p + 0.02 * anywhere()};
      double size = 3, feature = std::numeric_limits<double>::infinity(), bound = 3;
      for (const source_field& one : alone) {
        size = std::min(size, one(p));
        feature = std::min(feature, one.feature_size(p));
        bound = std::min(bound, one.smallest_size_in(box));
      }
      CHECK(field(p) == size);
      CHECK(field.feature_size(p) == feature);
      CHECK(field.smallest_size_in(box) <= size);
      CHECK(field.smallest_size_in(box) >= (1 - 1e-9) * bound);
    }
  }
}
