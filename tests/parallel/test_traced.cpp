#include "dovetail/distributed/processes.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/parallel/traced.hpp"
#include "parallel/executor_contract.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>

using namespace dovetail;

namespace {

std::vector<any_executor> executors() {
  return {any_executor(parallel::serial{}), any_executor(parallel::threads{2}),
          any_executor(parallel::processes{2})};
}

} // namespace

TEST_CASE("traced is an executor, whatever it runs on") {
  for (const any_executor& run : executors())
    contract::check_executor(parallel::traced(run));
}

TEST_CASE("A trace tells when each task ran, for how long, where, and what it returned") {
  for (const any_executor& run : executors()) {
    const parallel::traced traced(run);
    run_options options;
    options.stage = "sleeping";
    const auto outcomes = traced.run(
        4,
        [](std::size_t i) {
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
          if (i == 2)
            throw std::runtime_error("two");
          return byte_buffer(i);
        },
        options);
    CHECK(outcomes[3].result.size() == 3);
    const execution_trace trace = traced.trace();
    CHECK(trace.workers == run.workers());
    REQUIRE(trace.batches.size() == 1);
    const batch_span& batch = trace.batches[0];
    CHECK(batch.stage == "sleeping");
    CHECK(batch.failed == 1);
    CHECK(batch.begin >= 0);
    CHECK(batch.end <= trace.seconds);
    REQUIRE(batch.tasks.size() == 3);
    std::set<int> workers;
    for (const task_span& task : batch.tasks) {
      CHECK(task.result_bytes == task.task);
      CHECK(task.seconds >= 0.02);
      CHECK(task.begin >= 0);
      CHECK(batch.begin + task.begin + task.seconds <= batch.end);
      workers.insert(task.worker);
    }
    CHECK(*workers.begin() == 0);
    CHECK(static_cast<int>(workers.size()) == run.workers()); // each sleeps while the other takes one
    for (std::size_t i = 0; i + 1 < batch.tasks.size(); ++i)
      if (batch.tasks[i].worker == batch.tasks[i + 1].worker) // one after the other
        CHECK(batch.tasks[i].begin + batch.tasks[i].seconds <= batch.tasks[i + 1].begin);
  }
}

TEST_CASE("Stages begin with their first update and last until the next; copies have one record") {
  const parallel::traced traced(any_executor(parallel::serial{}));
  std::vector<std::string> seen;
  const progress watched = parallel::traced(traced).watch(
      {.update = [&](std::string_view stage, std::size_t, std::size_t) { seen.emplace_back(stage); }});
  for (const char* stage : {"first", "first", "second"}) {
    watched(stage, 0, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto trace = traced.trace();
  CHECK(seen == std::vector<std::string>{"first", "first", "second"});
  REQUIRE(trace.stages.size() == 2);
  CHECK(trace.stages[0].stage == "first");
  CHECK(trace.stages[0].end - trace.stages[0].begin >= 0.01);
  CHECK(trace.stages[0].end == trace.stages[1].begin);
  CHECK(trace.stages[1].end == trace.seconds);
}

TEST_CASE("What one does for all is noted with its stage, time and bytes") {
  const parallel::traced traced(any_executor(parallel::serial{}));
  traced.watch({})("partition", 0, 0);
  const auto bytes = traced.once([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return byte_buffer(5);
  });
  CHECK(bytes.size() == 5);
  const auto trace = traced.trace();
  REQUIRE(trace.batches.size() == 1);
  CHECK(trace.batches[0].once);
  CHECK(trace.batches[0].stage == "partition");
  REQUIRE(trace.batches[0].tasks.size() == 1);
  CHECK(trace.batches[0].tasks[0].seconds >= 0.01);
  CHECK(trace.batches[0].tasks[0].result_bytes == 5);
  CHECK(trace.batches[0].begin + trace.batches[0].tasks[0].seconds <= trace.batches[0].end);
}

TEST_CASE("What no batch fills all do alike") {
  execution_trace trace;
  trace.batches = {{"a", 1, 2}, {"b", 3, 5}};
  CHECK(seconds_alike(trace, 0, 6) == doctest::Approx(3));
  CHECK(seconds_alike(trace, 1.5, 4) == doctest::Approx(1));
  CHECK(seconds_alike(trace, 3, 5) == doctest::Approx(0));
}
