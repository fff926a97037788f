#include "dovetail/core/predicates.hpp"
#include "dovetail/remesh/constrained_triangulation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace dovetail;

namespace {

using segment_list = std::vector<std::array<local_id, 2>>;

/// Appends the closed loop over `points` to both lists.
void add_loop(std::vector<vec2>& all, segment_list& segments, const std::vector<vec2>& points) {
  const auto first = static_cast<local_id>(all.size());
  const auto count = static_cast<local_id>(points.size());
  all.insert(all.end(), points.begin(), points.end());
  for (local_id i = 0; i < count; ++i)
    segments.push_back({first + i, first + (i + 1) % count});
}

double area_of(const std::vector<vec2>& points, const segment_list& segments) {
  double twice = 0;
  for (const auto& [a, b] : segments)
    twice += cross(points[a], points[b]);
  return 0.5 * twice;
}

/// Area of all triangles; checks orientation, twins, and that the boundary consists of segments only.
double checked_area(const std::vector<vec2>& points, const corner_table& table) {
  double area = 0;
  for (local_id t = 0; t < table.triangle_slots(); ++t) {
    if (!table.alive(t))
      continue;
    const auto xy = [&](local_id i) { return points[table.vertex[3 * t + i]]; };
    CHECK(orient2d(xy(0), xy(1), xy(2)) > 0);
    area += 0.5 * cross(xy(1) - xy(0), xy(2) - xy(0));
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id d = table.twin[c];
      if (d == no_id) {
        CHECK(table.constraint[c] != no_id);
        continue;
      }
      CHECK(table.twin[d] == c);
      CHECK(table.tail(d) == table.head(c));
      CHECK(table.head(d) == table.tail(c));
    }
  }
  return area;
}

/// Undirected sides of a triangulation.
std::set<std::array<local_id, 2>> sides_of(const corner_table& table) {
  std::set<std::array<local_id, 2>> sides;
  for (local_id c = 0; c < static_cast<local_id>(table.vertex.size()); ++c)
    if (table.vertex[c] != no_id)
      sides.insert({std::min(table.tail(c), table.head(c)), std::max(table.tail(c), table.head(c))});
  return sides;
}

} // namespace

TEST_CASE("random loops are triangulated exactly or reported") {
  std::mt19937 random(7);
  int triangulated = 0;
  for (int run = 0; run < 3000; ++run) {
    const auto n = static_cast<local_id>(3 + random() % 12);
    const unsigned grid = run % 3 == 0 ? 4 : run % 3 == 1 ? 20 : 100000;
    std::vector<vec2> points(static_cast<std::size_t>(n));
    for (vec2& p : points)
      p = {static_cast<double>(random() % grid), static_cast<double>(random() % grid)};
    segment_list segments;
    for (local_id i = 0; i < n; ++i)
      segments.push_back({i, (i + 1) % n});
    const loop_triangulation made = triangulate_loops(points, segments);
    if (!made.valid())
      continue;
    ++triangulated;
    CHECK(checked_area(points, made.table) == doctest::Approx(area_of(points, segments)).epsilon(1e-12));
    const auto sides = sides_of(made.table);
    for (const auto& [a, b] : segments) {
      const local_id x = made.same_as[a], y = made.same_as[b];
      CHECK(sides.contains({std::min(x, y), std::max(x, y)}));
    }
  }
  CHECK(triangulated > 100);
}

TEST_CASE("holes stay empty and every triangle is locally Delaunay") {
  std::vector<vec2> points;
  segment_list segments;
  std::vector<vec2> outer, inner;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.0314159265358979 * i;
    outer.push_back({3 * std::cos(a), 2 * std::sin(a)});
    inner.push_back({0.5 + std::cos(-a), 0.7 * std::sin(-a)});
  }
  add_loop(points, segments, outer);
  add_loop(points, segments, inner);
  const loop_triangulation made = triangulate_loops(points, segments);
  REQUIRE(made.valid());
  CHECK(checked_area(points, made.table) == doctest::Approx(area_of(points, segments)).epsilon(1e-12));
  const auto xy = [&](local_id v) { return points[v]; };
  const corner_table& t = made.table;
  for (local_id c = 0; c < static_cast<local_id>(t.vertex.size()); ++c)
    if (t.vertex[c] != no_id && t.free_side(c))
      CHECK(in_circle(xy(t.vertex[c]), xy(t.tail(c)), xy(t.head(c)), xy(t.vertex[t.twin[c]])) <= 0);
}

TEST_CASE("crossing, touching and overlapping segments are reported as pairs") {
  segment_list segments;
  std::vector<vec2> bow_tie;
  add_loop(bow_tie, segments, {{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  auto made = triangulate_loops(bow_tie, segments);
  REQUIRE(made.crossings.size() == 1);
  CHECK(made.crossings[0] == std::array<local_id, 2>{0, 2});

  segments.clear();
  std::vector<vec2> touching;
  add_loop(touching, segments, {{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}); // (2, 0) lies on the first segment
  made = triangulate_loops(touching, segments);
  REQUIRE_FALSE(made.valid());
  CHECK(made.crossings[0][0] == 0);

  segments.clear();
  std::vector<vec2> repeated;
  add_loop(repeated, segments, {{0, 0}, {0, 0}, {1, 0}, {0, 1}});
  CHECK_FALSE(triangulate_loops(repeated, segments).valid());
}

TEST_CASE("a loop that runs backwards is reported") {
  std::vector<vec2> points;
  segment_list segments;
  add_loop(points, segments, {{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  const auto made = triangulate_loops(points, segments);
  CHECK(made.crossings.empty());
  CHECK(made.misplaced.size() == 4);
}

TEST_CASE("a slit has the domain on both sides") {
  std::vector<vec2> points;
  segment_list segments;
  add_loop(points, segments, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  points.push_back({0.2, 0.5});
  points.push_back({0.7, 0.5});
  segments.push_back({4, 5});
  segments.push_back({5, 4});
  const auto made = triangulate_loops(points, segments);
  REQUIRE(made.valid());
  CHECK(checked_area(points, made.table) == doctest::Approx(1));
  CHECK(sides_of(made.table).contains({4, 5}));
}

TEST_CASE("points at the same place, or all in one, do no harm") {
  const std::vector<vec2> origin(3);
  CHECK_FALSE(triangulate_loops(origin, segment_list{{0, 1}, {1, 2}, {2, 0}}).valid());
  const std::vector<vec2> far_away{{1e9, 1e9}, {1e9 + 1e-6, 1e9}, {1e9, 1e9 + 1e-6}};
  CHECK(triangulate_loops(far_away, segment_list{{0, 1}, {1, 2}, {2, 0}}).valid());
}
