#include "dovetail/core/error.hpp"
#include "dovetail/experiments/simulation/simulate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <tuple>

using namespace dovetail;
using namespace dovetail::simulation;

namespace {

workload tasks(std::size_t count, double seconds, double bytes = 0) {
  return {1, {{"meshing", 0, {}, {std::vector<simulated_task>(count, {seconds, bytes})}}}};
}

simulated_machine without_delays(std::int64_t workers) {
  return {.workers = workers, .latency = 0, .bandwidth = 1e300, .request_seconds = 0};
}

} // namespace

TEST_CASE("Without delays equal tasks take as many rounds as there are") {
  for (const auto& [count, workers, rounds] :
       {std::tuple{12, 1, 12}, {12, 4, 3}, {13, 4, 4}, {3, 8, 1}, {1000, 100000, 1}}) {
    const auto run = simulate(tasks(static_cast<std::size_t>(count), 2), without_delays(workers));
    CHECK(run.seconds == doctest::Approx(2 * rounds));
    CHECK(run.stages[0].busy == doctest::Approx(2 * count));
    CHECK(run.stages[0].idle == doctest::Approx(workers * run.seconds - 2 * count));
    CHECK(run.stages[0].managing == 0);
  }
}

TEST_CASE("What all do alike costs the same for any number of workers, and batches wait for each other") {
  workload work = tasks(4, 1);
  work.stages[0].batches.push_back(work.stages[0].batches[0]);
  work.stages[0].seconds_alike = 3;
  CHECK(simulate(work, without_delays(1)).seconds == doctest::Approx(3 + 8));
  CHECK(simulate(work, without_delays(3)).seconds == doctest::Approx(3 + 2 + 2)); // not 8 tasks in 3 rounds
  CHECK(simulate(work, without_delays(4)).seconds == doctest::Approx(3 + 2));
}

TEST_CASE("A manager who is slower than the workers decides") {
  // part manager
  simulated_machine machine = without_delays(1000);
  machine.request_seconds = 0.01;
  const auto run = simulate(tasks(5000, 1e-6), machine);
  // end
  CHECK(run.stages[0].managing == doctest::Approx(0.01 * 5000)); // one answer for each task
  CHECK(run.seconds == doctest::Approx(run.stages[0].managing).epsilon(0.01));
}

// With 100 bytes a second a request takes 0.16 s of a link, a grant 0.24, and a result of 49 bytes one
// second.
constexpr simulated_machine slow_network{
    .workers = 1, .latency = 0.5, .bandwidth = 100, .request_seconds = 0, .granted_ahead = 1};

TEST_CASE("A single worker sends nothing") {
  const auto run = simulate(tasks(4, 1, 49), slow_network);
  CHECK(run.seconds == doctest::Approx(4));
  CHECK(run.stages[0].link == 0);
}

TEST_CASE("Tasks come by request, and results are told to all in the end") {
  simulated_machine machine = slow_network;
  machine.workers = 2;
  auto run = simulate(tasks(4, 1, 49), machine);
  // The second worker gets its next task at 2.4 s, ends it, and is told at 4.8 that nothing is left.
  const double second = 1 + 0.16 + 0.5 + 0.24 + 0.5;
  const double ended = second + second;
  const double gathered = ended + 0.16 + 2 + 0.5;
  const double told = 0.16 + 4 + 2 * 0.08 + 0.5;
  CHECK(run.seconds == doctest::Approx(gathered + told));
  CHECK(run.stages[0].link == doctest::Approx(2 * (0.16 + 0.24) + 2.16 + 4.32));
  CHECK(run.stages[0].busy == doctest::Approx(4));
  machine.granted_ahead = 2; // dealt without a word: the answer comes while it works, but the last
  run = simulate(tasks(4, 1, 49), machine);
  CHECK(run.seconds == doctest::Approx(2 + 0.16 + 0.5 + 0.24 + 0.5 + 2.16 + 0.5 + told));
}

TEST_CASE("What comes in at once is served one after the other") {
  simulated_machine machine = slow_network;
  machine.workers = 3;
  // Both others ask at 1 s, the second is told at 2.64 s that nothing is left, when the first one's result is
  // still on the link.
  const double first_result = 1 + 0.16 + 0.5 + 0.24 + 0.5 + 1.16;
  const double told = 2 * (0.16 + 3 + 3 * 0.08 + 0.5);
  CHECK(simulate(tasks(3, 1, 49), machine).seconds == doctest::Approx(first_result + 1.16 + 0.5 + told));
  // However many send, their bytes are in each copy that the manager tells, and pass its link before.
  machine.latency = 0;
  for (const std::int64_t workers : {16, 64, 256}) {
    machine.workers = workers;
    const auto all = static_cast<double>(workers);
    const auto run = simulate(tasks(static_cast<std::size_t>(workers), 1, 1e6), machine);
    CHECK(run.seconds == doctest::Approx(1e4 * (all - 1 + all * std::log2(all))).epsilon(0.001));
    CHECK(run.stages[0].link == doctest::Approx(run.seconds).epsilon(0.001));
  }
}

TEST_CASE("Who is done early gives its results while others work") {
  simulated_machine machine = slow_network;
  machine.workers = 3;
  machine.latency = 0;
  workload work = tasks(3, 1, 49);
  work.stages[0].batches[0][2].seconds = 100;
  // The second worker's result passed long before; that of the last is waited for.
  CHECK(simulate(work, machine).seconds ==
        doctest::Approx(100 + 0.16 + 0.24 + 1.16 + 2 * (0.16 + 3 + 3 * 0.08)));
}

TEST_CASE("Workers without a task take part when results are told") {
  simulated_machine machine = slow_network;
  machine.workers = 1000;
  const auto run = simulate(tasks(1, 1, 49), machine);
  CHECK(run.seconds == doctest::Approx(1 + 10 * (0.16 + 1 + 1000 * 0.08 + 0.5)));
}

TEST_CASE("What one does for all takes its time and that of telling them, however few the cores") {
  workload work{1, {{"partition", 0, {{3, 50}, {1, 0}}}}};
  simulated_machine machine = slow_network;
  machine.cores = 1;
  CHECK(simulate(work, machine).stages[0].once == doctest::Approx(4));
  machine.workers = 4; // told in two rounds
  const auto run = simulate(work, machine);
  CHECK(run.stages[0].once == doctest::Approx(3 + 2 * (0.66 + 0.5) + 1 + 2 * (0.16 + 0.5)));
  CHECK(run.stages[0].link == doctest::Approx(2 * 0.66 + 2 * 0.16));
  CHECK(run.seconds == doctest::Approx(run.stages[0].once));
}

TEST_CASE("Ranks who share cores take turns with tasks, and are slower in what all do") {
  simulated_machine machine = without_delays(8);
  machine.cores = 2;
  CHECK(simulate(tasks(16, 1), machine).seconds == doctest::Approx(8));
  workload alike = tasks(1, 0);
  alike.stages[0].seconds_alike = 3;
  CHECK(simulate(alike, machine).stages[0].alike == doctest::Approx(12));
  machine.turns_cost = 0.1; // three more on each core
  CHECK(simulate(tasks(16, 1), machine).seconds == doctest::Approx(8));
  CHECK(simulate(alike, machine).stages[0].alike == doctest::Approx(12 * 1.3));
  machine.cores = 16;
  CHECK(simulate(alike, machine).stages[0].alike == doctest::Approx(3));
  CHECK(simulate(tasks(16, 1), machine).seconds == doctest::Approx(2));
}

TEST_CASE("A rank of several workers does once what all ranks do, and sends itself nothing") {
  simulated_machine machine = without_delays(8);
  machine.cores = 2;
  machine.workers_per_rank = 4; // two ranks on two cores
  workload work = tasks(16, 1);
  work.stages[0].seconds_alike = 3;
  CHECK(simulate(work, machine).seconds == doctest::Approx(3 + 8));
  machine.workers_per_rank = 3; // three of them
  CHECK(simulate(work, machine).seconds == doctest::Approx(4.5 + 8));
  simulated_machine slow = slow_network;
  slow.workers = slow.workers_per_rank = 4;
  slow.granted_ahead = 2;
  const auto alone = simulate(tasks(8, 1, 49), slow);
  CHECK(alone.seconds == doctest::Approx(2));
  CHECK(alone.stages[0].link == 0);
  slow.workers_per_rank = 2; // one other rank: it gives the results of two workers, and is told all
  CHECK(simulate(tasks(8, 1, 49), slow).stages[0].link > 4);
  CHECK_THROWS_AS(simulate(work, {.workers_per_rank = 0}), usage_error);
}

TEST_CASE("For any tasks the time is between the bounds of list scheduling") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    workload work = tasks(1 + random() % 300, 0);
    auto& batch = work.stages[0].batches[0];
    for (auto& task : batch)
      task.seconds = std::uniform_real_distribution<double>(0.1, 10)(random);
    const auto workers = static_cast<std::int64_t>(1 + random() % 40);
    simulated_machine machine = without_delays(workers);
    machine.granted_ahead = 1;
    const double sum = std::accumulate(batch.begin(), batch.end(), 0.0,
                                       [](double s, const simulated_task& t) { return s + t.seconds; });
    const double longest = std::max_element(batch.begin(), batch.end(), [](const auto& a, const auto& b) {
                             return a.seconds < b.seconds;
                           })->seconds;
    const double time = simulate(work, machine).seconds;
    const double share = sum / static_cast<double>(workers);
    CHECK(time >= std::max(share, longest) - 1e-9);
    CHECK(time <= share + longest + 1e-9); // Graham
  }
}

TEST_CASE("The bottleneck is the longest stage; machines that cannot be are refused") {
  workload work = tasks(8, 1);
  work.stages.push_back({"partition", 3});
  CHECK(bottleneck(simulate(work, without_delays(1))).stage == "meshing");
  CHECK(bottleneck(simulate(work, without_delays(8))).stage == "partition");
  CHECK_THROWS_AS(bottleneck(simulated_run{}), usage_error);
  CHECK_THROWS_AS(simulate(work, without_delays(0)), usage_error);
  CHECK_THROWS_AS(simulate(work, {.bandwidth = 0}), usage_error);
  CHECK_THROWS_AS(simulate(work, {.latency = -1}), usage_error);
  CHECK_THROWS_AS(simulate(work, {.turns_cost = -1}), usage_error);
  CHECK_THROWS_AS(simulate(work, {.granted_ahead = 0}), usage_error);
}
