#include "dovetail/core/nearest_point.hpp"
#include "dovetail/sizing/background.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/graded.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace dovetail;

static_assert(sizing_field<graded_size> && bounded_below_sizing_field<graded_size>);
static_assert(sizing_field<background_field> && bounded_below_sizing_field<background_field>);

namespace {

vec3 random_point(std::mt19937& random, double lower, double upper) {
  std::uniform_real_distribution<double> at(lower, upper);
  return {at(random), at(random), at(random)};
}

/// min over a dense cloud of y of h(y) + slope |x - y|.
template <class H>
double brute_force(const H& h, const std::vector<vec3>& cloud, vec3 x, double slope) {
  double least = h(x);
  for (const vec3& y : cloud)
    least = std::min(least, h(y) + slope * distance(x, y));
  return least;
}

} // namespace

TEST_CASE("a ball of small size grows by the slope, in every direction") {
  const auto h = [](vec3 p) { return norm(p) < 1 ? 0.1 : 2.0; };
  const graded_size g(h, {{-5, -5, -5}, {5, 5, 5}}, {.slope = 0.25, .relative_error = 0.05});
  MESSAGE("leaves ", g.leaf_count(), ", error ", g.error_bound());
  std::mt19937 random(5);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const vec3 p = random_point(random, -5, 5);
    const double exact = std::min(2.0, 0.1 + 0.25 * std::max(0.0, norm(p) - 1));
    worst = std::max(worst, std::abs(g(p) / exact - 1));
  }
  MESSAGE("worst relative error ", worst);
  CHECK(worst < 0.15);
}

TEST_CASE("small steep sources in a large box are seen and limited") {
  std::vector<grid_source> sources{point_source({1, 2, 3}, 0.01, 0.05, 0.002),
                                   line_source({-3, -3, -3}, {-1, -3, 2}, 0.05, 0.1, 0.02),
                                   triangle_source({4, 0, 0}, {4, 3, 0}, {4, 0, 3}, 0.1, 0.5, 0.05)};
  const source_field h(3.0, sources);
  const double slope = 0.3;
  const graded_size g(keep_bounds(h), {{-10, -10, -10}, {10, 10, 10}},
                      {.slope = slope, .relative_error = 0.1});
  MESSAGE("leaves ", g.leaf_count(), ", error ", g.error_bound());
  // Each source alone: its spacing, then a straight line from the inner radius; exact, since the source's own
  // growth is steeper.
  const auto exact = [&](vec3 p) {
    double least = 3.0;
    const auto from = [&](vec3 foot, double inner, double spacing) {
      least = std::min(least, spacing + slope * std::max(0.0, distance(foot, p) - inner));
    };
    from({1, 2, 3}, 0.01, 0.002);
    const auto s = nearest_on_segment({-3, -3, -3}, {-1, -3, 2}, p);
    from(s[0] * vec3{-3, -3, -3} + s[1] * vec3{-1, -3, 2}, 0.05, 0.02);
    const auto t = nearest_on_triangle({4, 0, 0}, {4, 3, 0}, {4, 0, 3}, p);
    from(t[0] * vec3{4, 0, 0} + t[1] * vec3{4, 3, 0} + t[2] * vec3{4, 0, 3}, 0.1, 0.05);
    return least;
  };
  std::mt19937 random(5);
  double worst = 0;
  const auto compare = [&](vec3 p) { worst = std::max(worst, std::abs(g(p) / exact(p) - 1)); };
  for (int i = 0; i < 5000; ++i) {
    compare(random_point(random, -10, 10));
    compare(vec3{1, 2, 3} + random_point(random, -0.05, 0.05));
    compare(vec3{4, 1, 1} + random_point(random, -0.5, 0.5));
    compare(vec3{-2, -3, -0.5} + random_point(random, -0.3, 0.3));
  }
  MESSAGE("worst relative error ", worst);
  CHECK(worst < 0.15);
  CHECK(g({1, 2, 3}) < 0.003);
}

TEST_CASE("the result is below the field, within the slope, and the same as the field where that is mild") {
  const auto h = [](vec3 p) { return 1 + 0.2 * std::sin(0.5 * p.x); };
  const graded_size g(h, {{-4, -4, -4}, {4, 4, 4}});
  std::mt19937 random(9);
  for (int i = 0; i < 5000; ++i) {
    const vec3 p = random_point(random, -4, 4);
    const vec3 q = random_point(random, -4, 4);
    CHECK(g(p) == doctest::Approx(h(p)).epsilon(0.1));
    CHECK(std::abs(g(p) - g(q)) <= 0.25 * distance(p, q) + 0.15);
  }
  CHECK(g({104, 0, 0}) == doctest::Approx(h({4, 0, 0}) + 25).epsilon(0.02));
}

TEST_CASE("the limited field of random data agrees with brute force within the stated error") {
  std::mt19937 random(17);
  std::vector<vec3> seeds;
  std::vector<double> sizes;
  std::uniform_real_distribution<double> size(0.05, 0.4);
  for (int i = 0; i < 40; ++i) {
    seeds.push_back(random_point(random, 0, 4));
    sizes.push_back(size(random));
  }
  struct steep_cones {
    const std::vector<vec3>& seeds;
    const std::vector<double>& sizes;
    double operator()(vec3 p) const { return smallest_size_in({p, p}); }
    double smallest_size_in(const box3& box) const {
      double least = 1.0;
      for (std::size_t i = 0; i < seeds.size(); ++i)
        least = std::min(least, sizes[i] + 1.5 * std::sqrt(distance_squared(box, seeds[i])));
      return least;
    }
  };
  const steep_cones h{seeds, sizes};
  const graded_size g(h, {{0, 0, 0}, {4, 4, 4}}, {.slope = 0.25, .relative_error = 0.1});
  MESSAGE("leaves ", g.leaf_count(), ", error ", g.error_bound());
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const vec3 p = random_point(random, 0, 4);
    worst = std::max(worst, std::abs(g(p) / brute_force(h, seeds, p, 0.25) - 1));
  }
  MESSAGE("worst relative error ", worst);
  CHECK(worst < 0.2);
}

TEST_CASE("gradation refuses bad parameters and fields") {
  const box3 box{{0, 0, 0}, {1, 1, 1}};
  CHECK_THROWS_AS(graded_size(uniform_size(1), box, {.slope = 0}), sizing_error);
  CHECK_THROWS_AS(graded_size(uniform_size(1), box, {.slope = -1}), sizing_error);
  CHECK_THROWS_AS(graded_size(uniform_size(1), box3{}), sizing_error);
  CHECK_THROWS_AS(graded_size([](vec3 p) { return p.x - 0.5; }, box), sizing_error);
}

TEST_CASE("the octree's lower bounds hold") {
  const source_field h(1.0, {point_source({1, 2, 3}, 0.1, 0.3, 0.02)});
  const graded_size g(h, {{0, 0, 0}, {4, 4, 4}});
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const vec3 a = random_point(random, -1, 5);
    const box3 box{a, a + vec3{0.7, 0.5, 0.9}};
    const double bound = g.smallest_size_in(box);
    CHECK(bound > 0);
    for (int j = 0; j < 20; ++j) {
      const vec3 t = random_point(random, 0, 1);
      CHECK(g(a + vec3{0.7 * t.x, 0.5 * t.y, 0.9 * t.z}) >= bound * (1 - 1e-9));
    }
  }
}

TEST_CASE("a background field interpolates linearly and extends by the nearest point") {
  simplicial_mesh<3> mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 2, 2}};
  mesh.elements = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  const auto linear = [](vec3 p) { return 1 + 0.1 * p.x + 0.2 * p.y + 0.3 * p.z; };
  std::vector<double> sizes;
  for (const vec3& p : mesh.points)
    sizes.push_back(linear(p));
  const background_field h(mesh, sizes);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 1000; ++i) {
    std::array<double, 4> w{unit(random), unit(random), unit(random), unit(random)};
    const double sum = w[0] + w[1] + w[2] + w[3];
    vec3 p{};
    for (std::size_t k = 0; k < 4; ++k)
      p += (w[k] / sum) * mesh.points[mesh.elements[i % 2][k]];
    CHECK(h(p) == doctest::Approx(linear(p)).epsilon(1e-12));
    const vec3 a = random_point(random, -1, 3);
    const box3 box{a, a + vec3{0.4, 0.4, 0.4}};
    const vec3 q = a + 0.4 * random_point(random, 0, 1);
    CHECK(h(q) >= h.smallest_size_in(box) * (1 - 1e-9));
  }
  CHECK(h({-5, 0, 0}) == doctest::Approx(1.0));
  CHECK(h({-5, 1, 0}) == doctest::Approx(1.2));
  CHECK(h({9, 9, 9}) == doctest::Approx(linear({2, 2, 2})));
  sizes[2] = -1;
  CHECK_THROWS_AS(background_field(mesh, sizes), sizing_error);
  sizes.pop_back();
  CHECK_THROWS_AS(background_field(mesh, sizes), sizing_error);
  CHECK_THROWS_AS(background_field(simplicial_mesh<3>{}, {}), sizing_error);
  CHECK_THROWS_AS(background_field(simplicial_mesh<2>{}, {}), sizing_error);
}
