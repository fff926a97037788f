#include "dovetail/core/fields.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"

#include <doctest/doctest.h>

#include <csignal>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

struct made {
  std::string text;
  std::vector<double> numbers;
  using fields = field_list<&made::text, &made::numbers>;
};

const std::vector<any_executor> executors{parallel::serial{}, parallel::threads{3}, parallel::processes{3}};

template <class Error>
void check_thrown(const any_executor& run) {
  const auto task = [](std::size_t i) {
    if (i % 3 == 1)
      throw Error("task " + std::to_string(i));
    return i;
  };
  CHECK_THROWS_WITH_AS((void)map_tasks(run, 8, task), "task 1", Error);
}

} // namespace

TEST_CASE("Values come back in order, whoever runs the tasks") {
  for (const any_executor& run : executors) {
    const auto results = map_tasks(run, 10, [](std::size_t i) {
      return made{std::string(i, 'x'), std::vector<double>(i, static_cast<double>(i))};
    });
    REQUIRE(results.size() == 10);
    for (std::size_t i = 0; i < 10; ++i) {
      REQUIRE(results[i].value);
      CHECK(results[i].value->text == std::string(i, 'x'));
      CHECK(results[i].value->numbers == std::vector<double>(i, static_cast<double>(i)));
    }
    CHECK(map_tasks(run, 0, [](std::size_t i) { return i; }).empty());
  }
}

namespace {

struct swapping_executor {
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    auto outcomes = parallel::serial{}.run(count, task, options);
    std::swap(outcomes.front(), outcomes.back());
    return outcomes;
  }
  int workers() const { return 2; }
  bool shares_process() const { return true; }
};
struct losing_executor : swapping_executor {
  std::string name() const { return "mine"; }
  std::vector<task_outcome> run(std::size_t, const task_function&, const run_options&) const { return {}; }
};

} // namespace

TEST_CASE("Of any executor, also one that nothing holds, results are checked") {
  const auto number = [](std::size_t i) { return i; };
  CHECK_THROWS_WITH_AS(map_tasks(swapping_executor{}, 2, number),
                       "the executor gave for task 0 another result than it returned", usage_error);
  CHECK_THROWS_WITH_AS(map_tasks(losing_executor{}, 2, number),
                       "the executor 'mine' gave 0 outcomes for 2 tasks", usage_error);
  CHECK_THROWS_WITH_AS(map_tasks(any_executor(losing_executor{}, "held"), 2, number),
                       "the executor 'held' gave 0 outcomes for 2 tasks", usage_error);
  CHECK(once(swapping_executor{}, [] { return 7; }) == 7);
  CHECK((leads(swapping_executor{}) && !has_others(swapping_executor{})));
  CHECK(results_of(swapping_executor{}) == nullptr);
}

TEST_CASE("A task that fails has no value and a reason; the others have theirs") {
  for (const any_executor& run : executors) {
    const auto results = map_tasks(run, 5, [](std::size_t i) {
      if (i == 2)
        throw mesher_error("two fails");
      if (i == 3)
        throw time_limit_error("three takes too long");
      return std::to_string(i);
    });
    CHECK(results[0].value == "0");
    CHECK(!results[2].value);
    CHECK(results[2].failure == "two fails");
    CHECK(!results[2].timed_out);
    CHECK(!results[3].value);
    CHECK(results[3].timed_out);
    CHECK(results[4].value == "4");
    CHECK_THROWS_WITH_AS((void)value_of(results[2], "the work"), "the work failed: two fails", mesher_error);
    CHECK_THROWS_WITH_AS((void)value_of(results[3], "the work"), "the work: three takes too long",
                         time_limit_error);
    CHECK_THROWS_AS((void)values_of(results, "the work"), mesher_error);
  }
}

TEST_CASE("A crash costs one value") {
  const auto results = map_tasks(parallel::processes{2}, 4, [](std::size_t i) {
    if (i == 1)
      std::raise(SIGKILL);
    return i;
  });
  CHECK(!results[1].value);
  CHECK(results[1].crashed);
  CHECK(results[1].failure.find("signal 9") != std::string::npos);
  CHECK(results[3].value == 3);
}

TEST_CASE("Errors that no other attempt mends are thrown, with their types: the first by number") {
  for (const any_executor& run : executors) {
    check_thrown<io_error>(run);
    check_thrown<sizing_error>(run);
    check_thrown<usage_error>(run);
  }
}

TEST_CASE("Tasks that return nothing are done or not, too") {
  for (const any_executor& run : executors) {
    const auto results = map_tasks(run, 4, [](std::size_t i) {
      if (i == 2)
        throw mesher_error("two fails");
    });
    CHECK(results[1].value);
    CHECK(!results[2].value);
  }
}

TEST_CASE("All ranks have all values") {
  for (const int size : {1, 2, 4})
    parallel::run_ranks(size, [&](parallel::in_process& mine) {
      const any_executor run = parallel::ranks(any_communicator(mine));
      const auto values = values_of(
          map_tasks(run, 9, [](std::size_t i) { return std::pair(i, std::to_string(i)); }), "the work");
      for (std::size_t i = 0; i < 9; ++i)
        CHECK(values[i] == std::pair(i, std::to_string(i)));
      check_thrown<sizing_error>(run);
      CHECK(once(run, [&] { return std::vector<int>{size, 1}; }) == std::vector<int>{size, 1});
      int calls = 0;
      once(run, [&] { ++calls; });
      CHECK(calls == (mine.rank() == 0 ? 1 : 0));
    });
}
