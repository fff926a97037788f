#include "dovetail/triangulation/delaunay.hpp"
#include "triangulation/triangulation_checks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

using namespace dovetail;
using dovetail_test::check_structure;
using dovetail_test::total_measure;
using dovetail_test::triangulate_and_check;

namespace {

template <int D>
point_of<D> made_of(double x, double y, double z) {
  if constexpr (D == 2)
    return {x + 0 * z, y};
  else
    return {x, y, z};
}

template <int D>
std::vector<point_of<D>> random_points(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> unit;
  std::vector<point_of<D>> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = unit(engine), y = unit(engine), z = unit(engine);
    points.push_back(made_of<D>(x, y, z));
  }
  return points;
}

/// Points of a small lattice, some twice and some a rounding away from it.
template <int D>
std::vector<point_of<D>> nearly_degenerate_points(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto coordinate = [&] {
    double x = static_cast<double>(1 + engine() % 5) * 0.1; // next to zero products would underflow
    if (engine() % 8 == 0)
      x = std::nextafter(x, 1.0);
    return x;
  };
  std::vector<point_of<D>> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    points.push_back(made_of<D>(x, y, z));
  }
  return points;
}

template <int D>
std::vector<point_of<D>> grid(int n, double step, double from = 0) {
  std::vector<point_of<D>> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < (D == 2 ? 1 : n); ++k)
        points.push_back(made_of<D>(from + i * step, from + j * step, from + k * step));
  return points;
}

} // namespace

TEST_CASE_TEMPLATE("random points are triangulated", D, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    triangulate_and_check<D::value>(random_points<D::value>(4 + 5 * seed, seed));
  }
  triangulate_and_check<D::value>(random_points<D::value>(5000, 99));
}

TEST_CASE("no sphere holds any other point at all") {
  const auto points = random_points<3>(300, 5);
  const auto made = triangulate_points<3>(points);
  std::size_t held = 0;
  for (local_id e = 0; e < static_cast<local_id>(made.triangulation.cells.size()); ++e)
    if (made.triangulation.is_alive(e) && !made.triangulation.is_ghost(e))
      for (const vec3 p : points)
        held += dovetail_test::sphere_side<3>(made.triangulation.points_of(e), p) > 0;
  CHECK(held == 0);
}

TEST_CASE_TEMPLATE("nearly degenerate points with doubles are triangulated", D,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    triangulate_and_check<D::value>(nearly_degenerate_points<D::value>(30 + 3 * seed, seed));
  }
}

TEST_CASE("nearly degenerate points are triangulated also where the box says nothing of them") {
  // The box around all of them is so large that no sphere of these points is decided by it.
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    auto points = nearly_degenerate_points<3>(60, seed);
    for (const double x : {-90.0, 100.0})
      for (const double y : {-90.0, 100.0})
        for (const double z : {-90.0, 100.0})
          points.push_back({x, y, z});
    triangulate_and_check<3>(points);
  }
}

TEST_CASE("spheres are decided as exactly in a large box as by themselves") {
  for (const double width : {0.5, 1.0, 1e3, 1e9}) {
    const detail::box_predicates<3> predicates({width, width, width});
    std::size_t zeros = 0, wrong = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
      auto p = nearly_degenerate_points<3>(5, seed);
      if (seed % 10 == 0)
        for (auto& one : p)
          one.z = 0.3; // all in one plane: the own extent is nothing
      if (orient3d(p[0], p[1], p[2], p[3]) < 0)
        std::swap(p[0], p[1]);
      const double found = predicates.in_sphere({&p[0], &p[1], &p[2], &p[3]}, p[4]);
      const double exact = in_sphere(p[0], p[1], p[2], p[3], p[4]);
      wrong += (found > 0) != (exact > 0) || (found < 0) != (exact < 0);
      zeros += exact == 0;
    }
    CHECK(wrong == 0);
    CHECK(zeros > 10);
  }
}

TEST_CASE_TEMPLATE("grids fill their box", D, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  for (const double step : {1.0, 0.1}) {
    const auto made = triangulate_and_check<D::value>(grid<D::value>(9, step, 0.3));
    CHECK(total_measure(made.triangulation) == doctest::Approx(std::pow(8 * step, D::value)));
  }
}

TEST_CASE("points of the surface of a cube, all of which are hull, fill it") {
  std::vector<vec3> points;
  for (const vec3 p : grid<3>(7, 0.1))
    if (std::min({p.x, p.y, p.z}) == 0 || std::max({p.x, p.y, p.z}) > 0.55)
      points.push_back(p);
  const auto made = triangulate_and_check<3>(points);
  CHECK(total_measure(made.triangulation) == doctest::Approx(std::pow(6 * 0.1, 3)));
}

TEST_CASE("cospherical and cocircular points are triangulated") {
  std::vector<vec3> sphere;
  for (int i = -5; i <= 5; ++i) // all integer points at distance 5 and 3 from the origin, and it
    for (int j = -5; j <= 5; ++j)
      for (int k = -5; k <= 5; ++k)
        if (const int d = i * i + j * j + k * k; d == 25 || d == 9)
          sphere.push_back({double(i), double(j), double(k)});
  triangulate_and_check<3>(sphere);
  sphere.push_back({0, 0, 0});
  triangulate_and_check<3>(sphere);
  std::vector<vec2> circle;
  for (int i = -65; i <= 65; ++i)
    for (int j = -65; j <= 65; ++j)
      if (i * i + j * j == 65 * 65)
        circle.push_back({double(i), double(j)});
  REQUIRE(circle.size() == 36);
  const auto made = triangulate_and_check<2>(circle);
  CHECK(elements_of(made.triangulation).elements.size() == 34);
}

TEST_CASE("a point in the middle of thousands on a sphere has a star of them all") {
  for (const int count : {4000, 4001, 4002}) { // its number decides when it is inserted
    std::vector<vec3> points;
    for (int i = 0; i < count; ++i) {
      const double z = -1 + (2.0 * i + 1) / count, angle = i * std::numbers::phi * 2 * std::numbers::pi;
      const double r = std::sqrt(1 - z * z);
      points.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    points.push_back({0, 0, 0});
    triangulate_and_check<3>(points);
  }
}

TEST_CASE("two skew lines, a plane and one point beside it, and a line with one beside it") {
  std::vector<vec3> lines;
  for (int i = 0; i < 40; ++i) {
    lines.push_back({0.1 * i, 0, 0});
    lines.push_back({0.7, 0.1 * i, 1});
  }
  const auto made = triangulate_and_check<3>(lines);
  CHECK(elements_of(made.triangulation).elements.size() == 39 * 39);
  std::vector<vec3> plane;
  for (const vec2 p : grid<2>(8, 0.1))
    plane.push_back({p.x, p.y, 1});
  plane.push_back({0.31, 0.42, 1.5});
  CHECK(elements_of(triangulate_and_check<3>(plane).triangulation).elements.size() == 2 * 49);
  std::vector<vec2> line{{0.35, 0.2}};
  for (int i = 0; i < 10; ++i)
    line.push_back({0.1 * i, 0.3});
  CHECK(elements_of(triangulate_and_check<2>(line).triangulation).elements.size() == 9);
}

TEST_CASE("points that are given several times are one vertex, of the lowest number") {
  auto points = random_points<3>(200, 3);
  const auto once = points;
  points.insert(points.begin(), once.rbegin(), once.rend());
  points.insert(points.end(), once.begin(), once.end());
  const auto made = triangulate_and_check<3>(points);
  std::set<local_id> vertices(made.same_as.begin(), made.same_as.end());
  CHECK(vertices.size() == 200);
  CHECK(*vertices.rbegin() == 199);
  CHECK(elements_of(made.triangulation).elements.size() == delaunay<3>(once).elements.size());
}

TEST_CASE("scales far apart are triangulated") {
  std::vector<vec3> points;
  for (const vec3 p : random_points<3>(400, 8))
    for (const double scale : {1.0, 1e-6, 1e6})
      points.push_back(scale * p);
  const auto made = triangulate_and_check<3>(points);
  CHECK(check_structure(made.triangulation) > 0);
}

TEST_CASE("the same points give the same triangulation; elements list neighbours by number") {
  const auto points = random_points<3>(2000, 12);
  const auto first = delaunay<3>(points), second = delaunay<3>(points);
  CHECK(first.elements == second.elements);
  CHECK(first.neighbours == second.neighbours);
  std::size_t hull = 0, faults = 0;
  for (std::size_t e = 0; e < first.elements.size(); ++e)
    for (const local_id n : first.neighbours[e]) {
      hull += n == no_id;
      faults += n != no_id && std::count(first.neighbours[n].begin(), first.neighbours[n].end(),
                                         static_cast<local_id>(e)) != 1;
    }
  CHECK(faults == 0);
  CHECK(hull == check_structure(triangulate_points<3>(points).triangulation));
}

TEST_CASE("input without a triangulation ends in a typed error") {
  CHECK_THROWS_AS(delaunay<3>({}), geometry_error);
  CHECK_THROWS_AS(delaunay<3>(random_points<3>(3, 1)), geometry_error);
  CHECK_THROWS_AS(delaunay<3>(std::vector<vec3>(10, vec3{1, 2, 3})), geometry_error);
  std::vector<vec3> plane, line;
  for (int i = 0; i < 50; ++i) {
    plane.push_back({0.1 * i, 0.1 * ((i * i) % 7), 0.25});
    line.push_back({0.5 * i, 0.25 * i, 2.0 * i});
  }
  CHECK_THROWS_WITH_AS(delaunay<3>(plane), doctest::Contains("one plane"), geometry_error);
  CHECK_THROWS_AS(delaunay<3>(line), geometry_error);
  CHECK_THROWS_WITH_AS(delaunay<2>(std::vector<vec2>{{0, 0}, {1, 1}, {2, 2}, {3, 3}}),
                       doctest::Contains("one line"), geometry_error);
  auto infinite = random_points<3>(10, 1);
  infinite[4].y = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(delaunay<3>(infinite), doctest::Contains("point 4"), geometry_error);
  infinite[4].y = std::nan("");
  CHECK_THROWS_AS(delaunay<3>(infinite), geometry_error);
}
