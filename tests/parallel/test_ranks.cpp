#include "dovetail/distributed/rank_tasks.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/self.hpp"
#include "parallel/executor_contract.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

using namespace dovetail;

TEST_CASE("ranks is an executor, whatever the number of ranks") {
  for (const int count : {1, 2, 4, 7}) {
    CAPTURE(count);
    parallel::run_ranks(
        count, [](parallel::in_process& mine) { contract::check_executor(parallel::ranks(mine), 1 << 20); });
  }
}

TEST_CASE("ranks runs tasks in forked workers where there is one rank in a process") {
  contract::check_executor(parallel::ranks(parallel::self{}, 2));
  CHECK_THROWS_AS(parallel::run_ranks(2, [](parallel::in_process& mine) { parallel::ranks(mine, 1); }),
                  usage_error);
}

TEST_CASE("Each task is run once, on whichever rank is free") {
  std::array<std::atomic<int>, 100> times{};
  std::array<std::atomic<int>, 4> by_rank{};
  parallel::run_ranks(4, [&](parallel::in_process& mine) {
    const int rank = mine.rank();
    const parallel::ranks run(mine);
    CHECK(run.workers() == 4);
    CHECK(run.network().leads() == (rank == 0));
    run.run(100, [&](std::size_t i) {
      ++times[i];
      ++by_rank[rank];
      std::this_thread::sleep_for(std::chrono::milliseconds(rank == 1 ? 40 : 1));
      return byte_buffer{};
    });
  });
  for (const auto& count : times)
    CHECK(count == 1);
  CHECK(by_rank[1] < 15); // two in the beginning, and one per request
  CHECK(by_rank[2] > 20);
}

TEST_CASE("What is made once is made by rank 0 and known to all, and so is its error") {
  std::atomic<int> made = 0;
  parallel::run_ranks(3, [&](parallel::in_process& mine) {
    const any_executor run = parallel::ranks(mine);
    CHECK(leads(run) == (mine.rank() == 0));
    CHECK(contract::decoded(once(run, [&] {
            ++made;
            return contract::encoded(static_cast<std::size_t>(40 + mine.rank()));
          })) == 40);
    const auto fail = [&]() -> byte_buffer { throw sizing_error("not a size"); };
    CHECK_THROWS_WITH_AS(once(run, fail), "not a size", sizing_error);
  });
  CHECK(made == 1);

  const any_executor alone = parallel::ranks(parallel::self{});
  CHECK(contract::decoded(once(alone, [] { return contract::encoded(7); })) == 7);
}

TEST_CASE("As many ranks of a machine take tasks as it has processors for, each in its turn") {
  using workers = std::vector<std::int32_t>;
  const std::vector<std::int32_t> two = {4, 5};
  const std::vector<detail::rank_place> one_machine(5, {"a", two, 1});
  CHECK(detail::workers_at_work(one_machine, 0) == workers{1, 1, 0, 0, 0});
  CHECK(detail::workers_at_work(one_machine, 3) == workers{0, 0, 0, 1, 1});
  CHECK(detail::workers_at_work(one_machine, 4) == workers{1, 0, 0, 0, 1});

  const std::vector<detail::rank_place> bound = {{"a", {0}, 1}, {"a", {1}, 1}, {"a", {2}, 1}};
  CHECK(detail::workers_at_work(bound, 7) == workers{1, 1, 1}); // each has a processor of its own
  const std::vector<detail::rank_place> crowded = {{"a", {0}, 2}, {"a", {1}, 3}};
  CHECK(detail::workers_at_work(crowded, 0) == workers{2, 3}); // and no other rank could use it

  const std::vector<detail::rank_place> mixed = {
      {"a", two, 1}, {"b", two, 2}, {"a", two, 1}, {"b", two, 2}, {"a", two, 7}};
  CHECK(detail::workers_at_work(mixed, 0) == workers{1, 2, 1, 0, 0});
  CHECK(detail::workers_at_work(mixed, 1) == workers{0, 0, 1, 2, 0});
  CHECK(detail::workers_at_work(mixed, 2) == workers{0, 2, 0, 0, 7}); // one at least
}

TEST_CASE("Ranks have two tasks for each of their workers in the beginning, the largest shared out") {
  using places = std::vector<std::size_t>;
  const std::vector<places> expected = {{0, 2, 3, 5}, {}, {1, 4}};
  const std::vector<places> of_few = {{0, 2}, {}, {1}};
  parallel::run_ranks(3, [&](parallel::in_process& mine) {
    const auto rank = static_cast<std::size_t>(mine.rank());
    any_communicator network(mine);
    CHECK(detail::rank_tasks(network, 9, {2, 0, 1}).granted() == expected[rank]);
    CHECK(detail::rank_tasks(network, 3, {2, 0, 1}).granted() == of_few[rank]);
  });
}

TEST_CASE("Ranks that do not work get no task, and wait until all is done") {
  for (const std::vector<std::int32_t>& workers :
       {std::vector<std::int32_t>{1, 0, 1, 0}, {0, 1, 3, 0}, {0, 1, 0, 0}}) {
    constexpr int tasks = 20;
    std::atomic<int> done = 0;
    parallel::run_ranks(4, [&](parallel::in_process& mine) {
      any_communicator network(mine);
      detail::rank_tasks feed(network, tasks, workers);
      while (!feed.ended()) {
        for (const std::size_t place : feed.granted()) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
          ++done;
          feed.finished(place);
        }
        network.wait(std::chrono::milliseconds(1));
      }
      const bool works = workers[network.rank()] > 0;
      CHECK(feed.finished_places().empty() == !works);
      if (!works)
        CHECK(done == tasks);
    });
    CHECK(done == tasks);
  }
}
