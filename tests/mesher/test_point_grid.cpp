#include "dovetail/mesher/native/piece_octree.hpp"
#include "dovetail/mesher/native/point_grid.hpp"
#include "mesher/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using namespace dovetail;

namespace {

/// Sizes that differ much within a few of them, so that cells of several widths are near each other.
double graded(vec3 p) {
  return 0.04 + 0.3 * std::max(0.0, norm(p) - 0.1);
}

struct random_points {
  detail::piece_octree piece{shapes::sphere(3), graded, {}};
  detail::point_grid grid{piece, 1.5};
  std::vector<vec3> places = {};
  std::mt19937_64 engine{5};

  vec3 random_place() {
    std::uniform_real_distribution<double> coordinate(-0.95, 0.95);
    for (;;)
      if (const vec3 p{coordinate(engine), coordinate(engine), coordinate(engine)}; norm(p) < 0.95)
        return p;
  }
  void add(vec3 p) {
    grid.add(piece.tree().locate(p), p, graded(p));
    places.push_back(p);
  }
  std::vector<std::uint32_t> within(vec3 place, double radius) const {
    std::vector<std::uint32_t> found;
    for (std::size_t k = 0; k < places.size(); ++k)
      if (norm_squared(places[k] - place) < radius * radius)
        found.push_back(static_cast<std::uint32_t>(k));
    return found;
  }
};

std::vector<std::uint32_t> sorted_ids(const std::vector<detail::gathered_point>& points) {
  std::vector<std::uint32_t> ids;
  for (const auto& one : points)
    ids.push_back(one.id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

} // namespace

TEST_CASE("Just the points within a radius are gathered, while points are added") {
  random_points points;
  std::vector<detail::gathered_point> gathered;
  std::size_t most = 0;
  for (int n = 0; n < 6000; ++n) {
    points.add(points.random_place());
    if (n % 3 != 0)
      continue;
    const vec3 place = points.random_place();
    const std::size_t leaf = points.piece.tree().locate(place);
    const double radius = 1.5 * points.piece.size_at(leaf, place) * (n % 7 + 1) / 7;
    REQUIRE(points.grid.gather(leaf, place, radius, 0, gathered));
    REQUIRE(sorted_ids(gathered) == points.within(place, radius));
    for (const auto& one : gathered) {
      REQUIRE(one.place == points.places[one.id]);
      REQUIRE(one.size == graded(one.place));
    }
    most = std::max(most, gathered.size());
  }
  CHECK(most > 40); // chunks of a cell were full
}

TEST_CASE("Points just within the radius are gathered, and points just outside are not") {
  std::vector<detail::gathered_point> gathered;
  std::mt19937_64 engine{7};
  std::normal_distribution<double> normal;
  for (int n = 0; n < 60; ++n) {
    random_points points;
    points.engine.seed(static_cast<std::uint64_t>(n));
    const vec3 place = 0.9 * points.random_place();
    const std::size_t leaf = points.piece.tree().locate(place);
    const double radius = points.piece.size_at(leaf, place);
    std::size_t inside = 0;
    for (int k = 0; k < 200; ++k) {
      const vec3 direction = normalized(vec3{normal(engine), normal(engine), normal(engine)});
      const vec3 p = place + (k % 2 == 0 ? 1 - 1e-12 : 1 + 1e-12) * radius * direction;
      if (norm(p) > 0.99)
        continue;
      points.add(p);
      inside += k % 2 == 0 ? 1 : 0;
    }
    points.grid.gather(leaf, place, radius, 0, gathered);
    CHECK(gathered.size() == inside);
  }
}

TEST_CASE("Gathering stops exactly where a point is too close") {
  random_points points;
  for (int n = 0; n < 3000; ++n)
    points.add(points.random_place());
  std::vector<detail::gathered_point> gathered;
  std::size_t stopped = 0, went_on = 0;
  for (int n = 0; n < 2000; ++n) {
    const vec3 place = points.random_place();
    const std::size_t leaf = points.piece.tree().locate(place);
    const double size = points.piece.size_at(leaf, place), too_close = 0.4 * size;
    const bool has_room = points.within(place, too_close).empty();
    REQUIRE(points.grid.gather(leaf, place, 1.3 * size, too_close, gathered) == has_room);
    if (has_room)
      REQUIRE(sorted_ids(gathered) == points.within(place, 1.3 * size));
    (has_room ? went_on : stopped) += 1;
  }
  CHECK(stopped > 100);
  CHECK(went_on > 100);
}
