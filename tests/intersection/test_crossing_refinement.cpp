#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/parallel/serial.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace dovetail;

namespace {

std::vector<surface_crossing> scattered_crossings(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-1, 1), exponent(-4, -1);
  std::vector<surface_crossing> crossings;
  for (int i = 0; i < count; ++i)
    crossings.push_back(
        {{no_id, no_id}, {at(random), at(random), at(random)}, std::pow(2, exponent(random))});
  crossings.push_back({{no_id, no_id}, {}, 0});
  return crossings;
}

/// Each crossing against all places before it.
std::vector<surface_crossing> places_by_definition(const std::vector<surface_crossing>& crossings) {
  std::vector<surface_crossing> places;
  for (const surface_crossing& crossing : crossings)
    if (std::none_of(places.begin(), places.end(), [&](const surface_crossing& place) {
          return place.size <= 1.2 * crossing.size && distance(place.center, crossing.center) < place.size;
        }))
      places.push_back(crossing);
  return places;
}

/// Two triangles that cross.
const std::vector<vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.9, 0.9, 1}};
const std::vector<simplex<2>> triangles{{0, 1, 2}, {3, 4, 5}};

/// Fails at every task.
struct failing {
  bool by_clock = false;

  std::vector<task_outcome> run(std::size_t count, const task_function&, const run_options& = {}) const {
    std::vector<task_outcome> outcomes(count);
    for (task_outcome& outcome : outcomes) {
      outcome.failure = "no answer";
      outcome.timed_out = by_clock;
    }
    return outcomes;
  }
  int workers() const { return 1; }
  bool shares_process() const { return false; }
};

} // namespace

TEST_CASE("one of each place is what comparing each crossing with all places gives") {
  const auto crossings = scattered_crossings(3000);
  const auto places = one_of_each_place(crossings), expected = places_by_definition(crossings);
  CHECK(expected.size() < crossings.size() / 2);
  REQUIRE(places.size() == expected.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    CHECK(places[i].center == expected[i].center);
}

TEST_CASE("a request to stop ends the search for crossings") {
  CHECK(crossing_triangles(points, triangles, {}, parallel::serial{}).size() == 1);
  CHECK_THROWS_AS(
      crossing_triangles(points, triangles, {}, parallel::serial{}, {}, {{}, [] { return true; }}),
      cancelled);
}

TEST_CASE("a search that fails or is stopped by the clock says which of both") {
  CHECK_THROWS_AS(crossing_triangles(points, triangles, {}, failing{}), mesher_error);
  CHECK_THROWS_AS(crossing_triangles(points, triangles, {}, failing{.by_clock = true}), time_limit_error);
}
