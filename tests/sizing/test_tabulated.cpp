#include "dovetail/sizing/point_sizes.hpp"
#include "dovetail/sizing/tabulated.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace dovetail;

static_assert(bounded_below_sizing_field<tabulated_size> && feature_aware_sizing_field<tabulated_size>);

namespace {

constexpr double growth = 0.25;
const box3 domain{{-1, -1, -1}, {1, 1, 1}};

vec3 random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> at(-reach, reach);
  return {at(random), at(random), at(random)};
}

/// Sizes from 0.02 up around points on a sphere.
point_sizes sizes_on_sphere() {
  std::mt19937 random(3);
  std::vector<sized_point> points;
  for (int i = 0; i < 3000; ++i) {
    const vec3 p = 0.7 * normalized(random_point(random, 1));
    points.push_back({p, 0.02 + 0.05 * std::abs(p.x)});
  }
  return {points, growth, 0.5};
}

} // namespace

TEST_CASE("precomputed sizes are off by no more than they say, and on the whole by little") {
  const point_sizes exact = sizes_on_sphere();
  const tabulated_size h(exact, domain, {.relative_error = 0.05});
  CHECK(h.error_bound() <= 0.05);
  std::mt19937 random(5);
  double worst = 0, sum = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const vec3 p = random_point(random, 1);
    const double off = h(p) / exact(p) - 1;
    worst = std::max(worst, std::abs(off));
    sum += off;
  }
  CHECK(worst < 0.87 * growth * 2); // the width of a leaf is at most twice the size
  CHECK(std::abs(sum / count) < 0.01);
}

TEST_CASE("a small size between the samples is not missed") {
  const point_sizes exact({{{0.123, 0.456, -0.321}, 1e-3}}, growth, 0.5);
  const tabulated_size h(exact, domain);
  CHECK(h({0.123, 0.456, -0.321}) < 1.5e-3);
}

TEST_CASE("the bound in a box is the least value there") {
  const tabulated_size h(sizes_on_sphere(), domain);
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    box3 box;
    box.include(random_point(random, 1.2));
    box.include(box.lower + (i % 2 == 0 ? 0.3 : 0.01) * vec3{1, 0.5, 0.7});
    const double bound = h.smallest_size_in(box);
    double least = 1;
    std::uniform_real_distribution<double> part(0, 1);
    for (int k = 0; k < 300; ++k) {
      const vec3 extent = box.upper - box.lower;
      least = std::min(least, h(box.lower + vec3{part(random) * extent.x, part(random) * extent.y,
                                                 part(random) * extent.z}));
    }
    CHECK(bound <= least * (1 + 1e-12));
    if (i % 2 != 0)
      CHECK(bound > 0.8 * least);
    if (!contains(domain, box.lower) || !contains(domain, box.upper))
      continue;
    double least_of_parts = 1;
    for (unsigned k = 0; k < 8; ++k)
      least_of_parts = std::min(least_of_parts, h.smallest_size_in(octant(box, k)));
    CHECK(bound == doctest::Approx(least_of_parts).epsilon(1e-12));
  }
}

TEST_CASE("outside the domain the field itself counts") {
  const point_sizes exact = sizes_on_sphere();
  const tabulated_size h(exact, domain);
  CHECK(h({2, 0.1, 0.2}) == exact({2, 0.1, 0.2}));
}

TEST_CASE("what cannot be precomputed is a typed error") {
  const point_sizes exact = sizes_on_sphere();
  CHECK_THROWS_AS(tabulated_size(exact, box3{}), sizing_error);
  CHECK_THROWS_AS(tabulated_size(exact, domain, {.relative_error = 0}), sizing_error);
}
