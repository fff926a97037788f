#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/intersection/single_sheet.hpp"
#include "dovetail/intersection/triangle_separation.hpp"
#include "dovetail/mesh/triangle_intersection.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

using namespace dovetail;

namespace {

using integer_point = std::array<std::int64_t, 3>;
using integer_triangle = std::array<integer_point, 3>;

integer_point minus(const integer_point& a, const integer_point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
integer_point times(const integer_point& a, const integer_point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool separated_along(const integer_point& axis, const integer_triangle& s, const integer_triangle& t) {
  const auto range = [&](const integer_triangle& triangle) {
    std::array<std::int64_t, 2> bounds{INT64_MAX, INT64_MIN};
    for (const integer_point& p : triangle) {
      const std::int64_t value = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
      bounds = {std::min(bounds[0], value), std::max(bounds[1], value)};
    }
    return bounds;
  };
  const auto a = range(s), b = range(t);
  return a[1] < b[0] || b[1] < a[0];
}

/// The separating-axis theorem in integers: exact, and nothing like the code under test.
bool meet_by_separating_axes(const integer_triangle& s, const integer_triangle& t) {
  std::vector<integer_point> axes;
  const auto edge = [](const integer_triangle& triangle, int i) {
    return minus(triangle[(i + 1) % 3], triangle[i]);
  };
  const integer_point normals[2] = {times(edge(s, 0), edge(s, 1)), times(edge(t, 0), edge(t, 1))};
  axes.insert(axes.end(), normals, normals + 2);
  for (int i = 0; i < 3; ++i) {
    axes.push_back(times(normals[0], edge(s, i)));
    axes.push_back(times(normals[1], edge(t, i)));
    for (int j = 0; j < 3; ++j)
      axes.push_back(times(edge(s, i), edge(t, j)));
  }
  return std::none_of(axes.begin(), axes.end(), [&](const auto& axis) {
    return axis != integer_point{} && separated_along(axis, s, t);
  });
}

bool has_area(const integer_triangle& t) {
  return times(minus(t[1], t[0]), minus(t[2], t[0])) != integer_point{};
}

vec3 real(const integer_point& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

struct random_triangles {
  std::mt19937 engine{7};
  integer_triangle operator()(int range, std::int64_t scale = 1) {
    std::uniform_int_distribution<int> coordinate(-range, range);
    integer_triangle t;
    do
      for (auto& p : t)
        p = {scale * coordinate(engine), scale * coordinate(engine), scale * coordinate(engine)};
    while (!has_area(t));
    return t;
  }
};

/// A square grid of n x n cells in the unit square, its points displaced at random by up to `displacement`
/// cells, in all directions.
struct rough_sheet {
  std::vector<vec3> points;
  std::vector<simplex<2>> triangles;

  rough_sheet(int n, double displacement, std::mt19937& engine) {
    std::uniform_real_distribution<double> by(-displacement / n, displacement / n);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        points.push_back(
            {static_cast<double>(i) / n + by(engine), static_cast<double>(j) / n + by(engine), by(engine)});
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const local_id corner = j * (n + 1) + i;
        triangles.push_back({corner, corner + 1, corner + n + 2});
        triangles.push_back({corner, corner + n + 2, corner + n + 1});
      }
  }

  std::vector<triangle_pair> pairs_by_testing_all() const {
    std::vector<triangle_pair> found;
    const auto count = static_cast<local_id>(triangles.size());
    for (local_id i = 0; i < count; ++i)
      for (local_id j = i + 1; j < count; ++j)
        if (triangles_cross(points, triangles[i], triangles[j]))
          found.push_back({i, j});
    return found;
  }
};

struct serial_run {
  std::size_t* tasks = nullptr; ///< counts them

  int workers() const { return 1; }
  bool shares_process() const { return true; }
  std::vector<task_outcome> run(std::size_t count, const task_function& task, const run_options&) const {
    if (tasks)
      *tasks += count;
    std::vector<task_outcome> outcomes(count);
    for (std::size_t i = 0; i < count; ++i)
      outcomes[i] = {.ok = true, .result = task(i), .failure = {}};
    return outcomes;
  }
};

} // namespace

TEST_CASE("disjoint triangles cross exactly when no axis separates them") {
  random_triangles random;
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto s = random(3), t = random(3);
    const std::vector<vec3> points{real(s[0]), real(s[1]), real(s[2]), real(t[0]), real(t[1]), real(t[2])};
    const bool expected = meet_by_separating_axes(s, t);
    REQUIRE(triangles_cross(points, {0, 1, 2}, {3, 4, 5}) == expected);
    REQUIRE(triangles_cross(points, {4, 3, 5}, {2, 0, 1}) == expected);
    crossing += expected;
  }
  CHECK(crossing > 1000);
  CHECK(crossing < 19000);
}

TEST_CASE("a shared vertex alone is no crossing, a common part beyond it is") {
  random_triangles random;
  constexpr std::int64_t scale = 3000; // so that cutting off a thousandth of a corner stays an integer
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto s = random(3, scale);
    auto t = random(3, scale);
    t[1] = s[0];
    if (!has_area(t))
      continue;
    const auto near_corner = [&](std::size_t corner) { // cuts off the corner at the shared vertex
      integer_point p = s[0];
      for (int k = 0; k < 3; ++k)
        p[k] += (s[corner][k] - s[0][k]) / 1000;
      return p;
    };
    const bool expected = meet_by_separating_axes({near_corner(1), s[1], s[2]}, t) ||
                          meet_by_separating_axes({near_corner(1), s[2], near_corner(2)}, t);
    const std::vector<vec3> points{real(s[0]), real(s[1]), real(s[2]), real(t[0]), real(t[2])};
    REQUIRE(triangles_cross(points, {0, 1, 2}, {3, 0, 4}) == expected);
    REQUIRE(triangles_cross(points, {3, 0, 4}, {0, 1, 2}) == expected);
    crossing += expected;
  }
  CHECK(crossing > 500);
}

TEST_CASE("two triangles on one edge cross only when folded flat onto each other") {
  const std::vector<vec3> points{{0, 0, 0},     {1, 0, 0},    {0.5, 1, 0},
                                 {0.2, 0.5, 0}, {0.5, -1, 0}, {0.5, 1, 1e-14}};
  CHECK(triangles_cross(points, {0, 1, 2}, {1, 0, 3}));
  CHECK_FALSE(triangles_cross(points, {0, 1, 2}, {1, 0, 4}));
  CHECK_FALSE(triangles_cross(points, {0, 1, 2}, {1, 0, 5}));
  CHECK(triangles_cross(points, {0, 1, 2}, {2, 0, 1}));
}

TEST_CASE("the octree finds the pairs that testing all pairs finds") {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> place(0, 1), extent(-0.08, 0.08);
  std::vector<vec3> points;
  std::vector<simplex<2>> triangles;
  for (local_id i = 0; i < 1500; ++i) {
    const vec3 center{place(engine), place(engine), place(engine)};
    for (int k = 0; k < 3; ++k)
      points.push_back(center + vec3{extent(engine), extent(engine), extent(engine)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const auto odd_with_odd = [](local_id i, local_id j) { return i % 2 == 1 && j % 2 == 1; };
  std::vector<triangle_pair> expected;
  for (local_id i = 0; i < 1500; ++i)
    for (local_id j = i + 1; j < 1500; ++j)
      if (!odd_with_odd(i, j) && triangles_cross(points, triangles[i], triangles[j]))
        expected.emplace_back(i, j);
  REQUIRE(expected.size() > 100);
  CHECK(crossing_triangles(points, triangles, odd_with_odd, serial_run{}) == expected);
  CHECK(crossing_triangles(points, triangles, odd_with_odd, serial_run{}, {.leaf_size = 10}) == expected);
}

TEST_CASE("in a mesh, quick proofs hide no crossing: flat, rough, and folded over itself") {
  std::mt19937 engine(5);
  for (const double displacement : {0.0, 0.1, 0.3, 0.5, 0.7, 1.0})
    for (int trial = 0; trial < 4; ++trial) {
      const rough_sheet sheet(16, displacement, engine);
      const auto expected = sheet.pairs_by_testing_all();
      if (displacement != 0.5)
        CHECK(expected.empty() == (displacement < 0.5));
      CHECK(crossing_triangles(sheet.points, sheet.triangles, {}, serial_run{}) == expected);
    }
}

TEST_CASE("a large mesh is searched in many tasks, and what crosses between their cells is found once") {
  std::mt19937 engine(17);
  const rough_sheet sheet(40, 0.6, engine);
  const auto expected = sheet.pairs_by_testing_all();
  REQUIRE(expected.size() > 20);
  std::size_t tasks = 0;
  CHECK(crossing_triangles(sheet.points, sheet.triangles, {}, serial_run{&tasks}) == expected);
  CHECK(tasks > 2);
}

TEST_CASE("a set is called a single sheet only when none of its triangles cross") {
  std::mt19937 engine(11);
  int proven = 0, crossing = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const rough_sheet sheet(3, trial % 2 == 0 ? 0.3 : 0.6, engine);
    std::vector<local_id> set; // with gaps, so that outlines are of all kinds
    for (local_id t = 0; t < static_cast<local_id>(sheet.triangles.size()); ++t)
      if (engine() % 8 != 0)
        set.push_back(t);
    const auto in_set = [&](local_id t) { return std::binary_search(set.begin(), set.end(), t); };
    const auto pairs = sheet.pairs_by_testing_all();
    const bool crosses = std::any_of(pairs.begin(), pairs.end(),
                                     [&](const auto& p) { return in_set(p.first) && in_set(p.second); });
    const bool is_sheet = single_sheet(sheet.points, sheet.triangles)(set);
    REQUIRE_FALSE((crosses && is_sheet));
    proven += is_sheet;
    crossing += crosses;
  }
  CHECK(proven > 50);
  CHECK(crossing > 100);
}

TEST_CASE("a sheet that comes back over itself is no single one, though all of it faces one way") {
  // A ramp around a corner: one turn and a quarter, in eight triangles per quarter, rising.
  std::vector<vec3> points;
  std::vector<simplex<2>> triangles;
  constexpr int steps = 10;
  for (int k = 0; k <= steps; ++k) {
    const double angle = k * std::numbers::pi / 4, height = 1e-3 * k;
    points.push_back({std::cos(angle), std::sin(angle), height});
    points.push_back({2 * std::cos(angle), 2 * std::sin(angle), height});
  }
  for (local_id k = 0; k < steps; ++k) {
    triangles.push_back({2 * k, 2 * k + 1, 2 * k + 3});
    triangles.push_back({2 * k, 2 * k + 3, 2 * k + 2});
  }
  const auto first = [](local_id count) {
    std::vector<local_id> set(static_cast<std::size_t>(count));
    std::iota(set.begin(), set.end(), local_id{0});
    return set;
  };
  single_sheet is_sheet(points, triangles);
  CHECK(is_sheet(first(14)));       // three quarters and a half
  CHECK_FALSE(is_sheet(first(20))); // beyond the start
}

TEST_CASE("no single sheet: a fold, edges passed twice, parts over each other, an outline that goes back "
          "over itself") {
  const auto is_sheet = [](const std::vector<vec3>& points, const std::vector<simplex<2>>& triangles) {
    std::vector<local_id> all(triangles.size());
    std::iota(all.begin(), all.end(), local_id{0});
    return single_sheet(points, triangles)(all);
  };

  // A strip that climbs and comes down: all of it is turned by less than a right angle from its first
  // triangles, but not from the whole.
  const auto strip = [&](const std::vector<vec2>& profile) {
    std::vector<vec3> points;
    std::vector<simplex<2>> triangles;
    for (const vec2& p : profile) {
      points.push_back({p.x, 0, p.y});
      points.push_back({p.x, 1, p.y});
    }
    for (local_id k = 0; k + 2 < static_cast<local_id>(points.size()); k += 2) {
      triangles.push_back({k, k + 2, k + 3});
      triangles.push_back({k, k + 3, k + 1});
    }
    return is_sheet(points, triangles);
  };
  CHECK(strip({{0, 0}, {1, 0}, {1.2, 3}}));
  CHECK_FALSE(strip({{0, 0}, {1, 0}, {1.2, 3}, {1.3, 2}}));

  // A hood whose apex hangs over its rim: its last triangle shows its back, turned from the first as it is.
  CHECK_FALSE(is_sheet({{0, 0, 0}, {-4, -1, -4}, {4, 4, -1}, {1, 3, 1}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));

  // Two hoods on one rim, through each other, beside another triangle.
  const std::vector<vec3> hoods{{0, 0, 0},       {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.1},
                                {0.4, 0.3, 0.1}, {5, 5, 0}, {6, 5, 0}, {5, 6, 0}};
  CHECK(is_sheet(hoods, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  CHECK_FALSE(is_sheet(hoods, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}, {5, 6, 7}}));

  // Two triangles through each other, without a common point or with one.
  const std::vector<vec3> apart{{0, 0, 0},        {2, 0, 0},       {0, 2, 0},
                                {0.5, 0.5, -0.1}, {2.5, 0.5, 0.1}, {0.5, 2.5, 0}};
  CHECK(triangles_cross(apart, {0, 1, 2}, {3, 4, 5}));
  CHECK_FALSE(is_sheet(apart, {{0, 1, 2}, {3, 4, 5}}));
  CHECK_FALSE(is_sheet(apart, {{0, 1, 2}, {0, 4, 5}}));

  // A fan that closes: its last side lies along its first one, which is as long, shorter or longer.
  for (const double last : {0.5, 1.0, 2.0}) {
    std::vector<vec3> points{{0, 0, 0}};
    std::vector<simplex<2>> fan;
    for (const vec2 p : {vec2{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {last, 0}}) {
      points.push_back({p.x, p.y, 0});
      if (points.size() > 2)
        fan.push_back(
            {0, static_cast<local_id>(points.size()) - 2, static_cast<local_id>(points.size()) - 1});
    }
    CHECK_FALSE(is_sheet(points, fan));
    fan.pop_back();
    CHECK(is_sheet(points, fan));
  }
}

TEST_CASE("neighbours in a smooth surface are separated by a plane; crossing triangles never are") {
  std::mt19937 engine(13);
  const rough_sheet smooth(8, 0.05, engine);
  int separated = 0, pairs = 0;
  for (std::size_t i = 0; i < smooth.triangles.size(); ++i)
    for (std::size_t j = i + 1; j < smooth.triangles.size(); ++j, ++pairs)
      separated += separated_by_a_plane(smooth.points, smooth.triangles[i], smooth.triangles[j]);
  CHECK(separated == pairs);
  const rough_sheet folded(12, 0.8, engine);
  const auto crossing = folded.pairs_by_testing_all();
  REQUIRE(crossing.size() > 20);
  for (const auto& [i, j] : crossing)
    REQUIRE_FALSE(separated_by_a_plane(folded.points, folded.triangles[i], folded.triangles[j]));
}
