#include "dovetail/core/error.hpp"
#include "dovetail/experiments/simulation/workload.hpp"

#include <doctest/doctest.h>

#include <numeric>
#include <string>

using namespace dovetail;
using namespace dovetail::simulation;

namespace {

/// A stage in which all do alike, one with the tasks of two batches.
workload run_of(double elements, double alike, std::size_t tasks, double seconds) {
  const std::vector<simulated_task> batch(tasks, {seconds, 100});
  return {elements, {{"planning", alike}, {"meshing", 0, {}, {batch, batch}}}};
}

} // namespace

TEST_CASE("Stages come from a trace in their order, batches to the stage of their name or of their time") {
  execution_trace trace{.workers = 2, .elements = 10, .seconds = 10};
  trace.stages = {{"planning", 0, 3}, {"skeleton", 3, 4.5}, {"planning", 4.5, 5}, {"meshing", 5, 10}};
  trace.batches = {{"coarse surface", 1, 2, {{0, 0, 0.5, 0.5, 7}, {1, 0, 0, 0.5, 8}}},
                   {"coarse surface", 2, 2.5, {}, 3},
                   {"meshing", 2.75, 2.75, {{0, 0, 0, 0.5, 1}}}, // of what is planned
                   {"planning", 4.75, 4.8, {{0, 0, 0, 0.025, 6}}, 0, true},
                   {"meshing", 5, 9, {{0, 0, 0, 4, 9}}}};
  trace.sizes = {4, 5, 6};
  const workload work = workload_of(trace);
  CHECK(work.elements == 10);
  CHECK(work.sizes == trace.sizes);
  REQUIRE(work.stages.size() == 3);
  CHECK(work.stages[0].stage == "planning");
  CHECK(work.stages[0].seconds_alike == doctest::Approx(1.5 + 0.45));
  REQUIRE(work.stages[0].once.size() == 1);
  CHECK(work.stages[0].once[0].seconds == doctest::Approx(0.025));
  CHECK(work.stages[0].once[0].bytes == 6);
  REQUIRE(work.stages[0].batches.size() == 2);
  CHECK(work.stages[0].batches[0][0].bytes == 8); // it began first
  CHECK(work.stages[0].batches[1][0].bytes == 1);
  CHECK(work.stages[1].seconds_alike == doctest::Approx(1.5));
  CHECK(work.stages[2].stage == "meshing");
  CHECK(work.stages[2].seconds_alike == doctest::Approx(1));
  REQUIRE(work.stages[2].batches.size() == 1);
  CHECK(work.stages[2].batches[0][0].seconds == 4);
  CHECK_THROWS_AS(workload_of(execution_trace{}), usage_error);
}

TEST_CASE("Work for more elements follows the power laws of two runs") {
  // Alike with the power 1/2, tasks linear, the time of one with none.
  const workload scaled = scaled_to(16e6, run_of(1e6, 1, 10, 3), run_of(4e6, 2, 40, 3));
  CHECK(scaled.elements == 16e6);
  REQUIRE(scaled.stages.size() == 2);
  CHECK(scaled.stages[0].seconds_alike == doctest::Approx(4));
  REQUIRE(scaled.stages[1].batches.size() == 2);
  CHECK(scaled.stages[1].batches[1].size() == 160);
  CHECK(scaled.stages[1].batches[0][7].seconds == doctest::Approx(3));

  // As many tasks, each of more: by the same law.
  const workload larger = scaled_to(16e6, run_of(1e6, 1, 10, 1), run_of(4e6, 1, 10, 4));
  CHECK(larger.stages[0].seconds_alike == doctest::Approx(1));
  CHECK(larger.stages[1].batches[0].size() == 10);
  CHECK(larger.stages[1].batches[0][0].seconds == doctest::Approx(16));

  // What one does for all has a law of its own.
  workload small = run_of(1e6, 1, 10, 1), large = run_of(4e6, 1, 10, 1);
  small.stages[0].once = {{1, 100}, {2, 100}};
  large.stages[0].once = {{8, 400}, {4, 400}};
  const workload once = scaled_to(16e6, small, large);
  CHECK(once.stages[0].seconds_alike == doctest::Approx(1));
  REQUIRE(once.stages[0].once.size() == 2);
  CHECK(once.stages[0].once[0].seconds == doctest::Approx(32));
  CHECK(once.stages[0].once[1].bytes == doctest::Approx(1600));
}

TEST_CASE("Sizes have a law each, unless a run does not know them") {
  workload small = run_of(1e6, 1, 10, 1), large = run_of(4e6, 1, 10, 1);
  large.sizes = {100, 200, 300};
  CHECK_FALSE(scaled_to(16e6, small, large).sizes.are_known());
  small.sizes = {100, 100, 10}; // the last one grows faster than the elements
  const mesh_sizes scaled = scaled_to(16e6, small, large).sizes;
  CHECK(scaled.background_elements == doctest::Approx(100));
  CHECK(scaled.skeleton_sides == doctest::Approx(400));
  CHECK(scaled.largest_piece == doctest::Approx(1200));
}

TEST_CASE("Scaled to itself a run is what it was, but for the rest of its tasks it keeps their costs") {
  workload large = run_of(4e6, 2, 3, 1);
  large.stages[1].batches[0] = {{5, 1}, {2, 1}, {1, 1}};
  const workload same = scaled_to(4e6, run_of(1e6, 1, 3, 1), large);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(same.stages[1].batches[0][i].seconds == doctest::Approx(large.stages[1].batches[0][i].seconds));

  large.stages[1].batches = {{{5, 1}, {2, 1}, {1, 1}}};
  workload small = run_of(2e6, 1, 1, 1);
  small.stages[1].batches = {{{8. / 3, 1}}}; // a third of the tasks with half the elements, of the same mean
  const workload twice = scaled_to(8e6, small, large);
  REQUIRE(twice.stages[1].batches[0].size() == 6); // no more than in proportion
  const std::vector<double> expected = {5, 5, 2, 2, 1, 1};
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(twice.stages[1].batches[0][i].seconds == doctest::Approx(expected[i]));
}

TEST_CASE("A law needs two sizes; what is too short for one grows with the elements") {
  CHECK_THROWS_WITH_AS(scaled_to(1e9, run_of(1e6, 1, 1, 1), run_of(1.2e6, 1, 1, 1)),
                       doctest::Contains("at least 1.5 times"), usage_error);
  const workload scaled = scaled_to(4e6, run_of(1e6, 1e-4, 1, 1), run_of(2e6, 1e-4, 1, 1));
  CHECK(scaled.stages[0].seconds_alike == doctest::Approx(2e-4));
}
