#include "dovetail/core/error.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/memo.hpp"
#include "dovetail/parallel/remembering.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <csignal>
#include <numeric>
#include <string>

using namespace dovetail;

namespace {

const run_identity identity{{"input", "abc"}};

byte_buffer bytes_of(std::uint64_t name) {
  return byte_buffer(static_cast<std::size_t>(name % 7), static_cast<std::byte>(name));
}
std::vector<byte_buffer> make_of(std::span<const kept<byte_buffer>> results,
                                 const std::vector<std::size_t>& wanted) {
  std::vector<byte_buffer> made;
  for (const std::size_t i : wanted)
    made.push_back(bytes_of(results[i].key().value));
  return made;
}
std::vector<kept<byte_buffer>> named_from(std::uint64_t first, std::uint64_t count) {
  std::vector<kept<byte_buffer>> results;
  for (std::uint64_t k = first; k < first + count; ++k)
    results.emplace_back(content_key{k});
  return results;
}

/// Makes what is missing of `results`, three to a task, and checks all of them.
std::size_t make_and_check(memo<byte_buffer>& table, const std::vector<kept<byte_buffer>>& results,
                           const any_executor& run) {
  const std::size_t before = table.made();
  const auto failures = table.make_missing(
      results, std::vector<double>(results.size(), 1), 3,
      [&](const std::vector<std::size_t>& wanted) { return make_of(results, wanted); }, run, {});
  CHECK(failures.empty());
  std::size_t next = 0;
  table.for_each(results, [&](std::size_t i, const byte_buffer& bytes) {
    CHECK(i == next++);
    CHECK(bytes == bytes_of(results[i].key().value));
  });
  CHECK(next == results.size());
  return table.made() - before;
}

memo<byte_buffer> on_disk_of(const spool& disk) {
  return {parallel::checkpointed(parallel::serial{}, disk), "batches"};
}

const std::vector<any_executor> kinds_of_executor{parallel::serial{}, parallel::threads{3},
                                                  parallel::processes{3}};

} // namespace

TEST_CASE("What is there is not made again, in memory and on disk, whoever runs the tasks") {
  for (const any_executor& run : kinds_of_executor)
    for (const bool on_disk : {false, true}) {
      const testing::scratch_folder scratch("batches");
      auto table = on_disk ? on_disk_of(spool::start(scratch, identity)) : memo<byte_buffer>();
      CHECK(make_and_check(table, named_from(10, 20), run) == 20);
      CHECK(make_and_check(table, named_from(10, 20), run) == 0);
      CHECK(make_and_check(table, named_from(5, 20), run) == 5);
      CHECK(make_and_check(table, {}, run) == 0);
    }
}

TEST_CASE("A resumed run finds the batches of the earlier one") {
  const testing::scratch_folder scratch("batches");
  const auto results = named_from(1, 10);
  auto first = on_disk_of(spool::start(scratch, identity));
  make_and_check(first, results, parallel::processes{2});
  std::atomic<int> made = 0;
  auto second = on_disk_of(spool::resume(scratch, identity));
  const auto again = [&](const std::vector<std::size_t>& wanted) {
    made += static_cast<int>(wanted.size());
    return make_of(results, wanted);
  };
  CHECK(second.make_missing(results, std::vector<double>(10, 1), 3, again, parallel::serial{}, {}).empty());
  CHECK(made == 0);
  CHECK(second.made() == 0);
  second.for_each(results, [&](std::size_t i, const byte_buffer& bytes) {
    CHECK(bytes == bytes_of(results[i].key().value));
  });
}

TEST_CASE("An entity is made once per batch of its cost, the costliest batch first") {
  const auto results = named_from(0, 6);
  const std::vector<double> costs{1, 1, 1, 9, 1, 1};
  std::vector<std::vector<std::size_t>> batches;
  memo<byte_buffer> table;
  table.make_missing(results, costs, 3,
                     [&](const std::vector<std::size_t>& wanted) {
                       batches.push_back(wanted);
                       return make_of(results, wanted);
                     },
                     parallel::serial{}, {});
  CHECK(batches == std::vector<std::vector<std::size_t>>{{3}, {0, 1, 2}, {4, 5}});
}

TEST_CASE("Of batches that fail, the table that fail alone are named; a crash too. The others go on") {
  const auto results = named_from(0, 9);
  for (const bool crashes : {false, true}) {
    memo<byte_buffer> table;
    const auto make_all = [&](std::span<const kept<byte_buffer>> wanted_results, bool faulty) {
      return table.make_missing(wanted_results, std::vector<double>(wanted_results.size(), 1), 3,
                                [&](const std::vector<std::size_t>& wanted) {
                                  for (const std::size_t i : wanted)
                                    if (faulty && i == 4 && crashes)
                                      std::raise(SIGKILL);
                                    else if (faulty && (i == 1 || i == 4))
                                      throw mesher_error(std::to_string(i) + " fails");
                                  return make_of(results, wanted);
                                },
                                parallel::processes{2}, {});
    };
    const auto failures = make_all(results, true);
    REQUIRE(failures.size() == 2);
    CHECK(failures[0].number == 1);
    CHECK(failures[0].reason.find("1 fails") != std::string::npos);
    CHECK(failures[1].number == 4);
    CHECK(failures[1].reason.find(crashes ? "signal 9" : "4 fails") != std::string::npos);
    CHECK(table.made() == 7); // the third batch, and what can be made alone of the others
    CHECK(make_all(results, false).empty());
    CHECK(table.made() == 9);
  }
}

TEST_CASE("No member of a batch is blamed for what only all of them together do") {
  const auto results = named_from(0, 9);
  for (const any_executor& run : {any_executor(parallel::serial{}), any_executor(parallel::processes{1}),
                                  any_executor(parallel::processes{4})}) {
    memo<byte_buffer> table;
    const auto not_together = [&](const std::vector<std::size_t>& wanted) {
      if (wanted.size() > 1)
        throw mesher_error("too much for one task");
      if (wanted.front() == 5)
        throw mesher_error("5 fails");
      return make_of(results, wanted);
    };
    const auto failures = table.make_missing(results, std::vector<double>(9, 1), 3, not_together, run, {});
    REQUIRE(failures.size() == 1);
    CHECK(failures[0].number == 5);
    CHECK(failures[0].reason == "5 fails");
    CHECK(table.made() == 8);
    const auto only_it = [&](const std::vector<std::size_t>& wanted) {
      CHECK(wanted == std::vector<std::size_t>{5});
      return make_of(results, wanted);
    };
    CHECK(table.make_missing(results, std::vector<double>(9, 1), 3, only_it, parallel::serial{}, {}).empty());
    table.for_each(results, [&](std::size_t i, const byte_buffer& bytes) {
      CHECK(bytes == bytes_of(results[i].key().value));
    });
  }
}

TEST_CASE("A blob that has gone is an error that names it") {
  const testing::scratch_folder scratch("batches");
  const auto disk = spool::start(scratch, identity);
  const auto results = named_from(1, 3);
  auto table = on_disk_of(disk);
  make_and_check(table, results, parallel::serial{});
  disk.clear();
  CHECK_THROWS_AS(table.for_each(results, [](std::size_t, const byte_buffer&) {}), io_error);
}

TEST_CASE("What no other attempt mends is thrown as what it is, and nothing is made twice") {
  const auto results = named_from(1, 9);
  for (const any_executor& run : kinds_of_executor) {
    const testing::scratch_folder scratch("batches");
    const auto disk = spool::start(scratch, identity);
    auto table = on_disk_of(disk);
    disk.clear(); // no folder to write to
    CHECK_THROWS_AS(make_and_check(table, results, run), io_error);
    memo<byte_buffer> others;
    const auto no_size = [](const std::vector<std::size_t>&) -> std::vector<byte_buffer> {
      throw sizing_error("the size is 0");
    };
    CHECK_THROWS_WITH_AS(others.make_missing(results, std::vector<double>(9, 1), 3, no_size, run, {}),
                         "the size is 0", sizing_error);
  }
}

TEST_CASE("Memos of one executor that remembers have what the others made; without one each has its own") {
  const auto results = named_from(1, 6);
  for (const bool keeps : {true, false}) {
    const any_executor run =
        keeps ? any_executor(parallel::remembering(parallel::serial{})) : any_executor(parallel::serial{});
    CHECK((run.results() != nullptr) == keeps);
    memo<byte_buffer> first(run, "batches"), second(run, "batches"), others(run, "others");
    make_and_check(first, results, run);
    int runs = 0;
    const auto make = [&](const std::vector<std::size_t>& wanted) {
      ++runs;
      return make_of(results, wanted);
    };
    second.make_missing(results, std::vector<double>(6, 1), 3, make, run, {});
    CHECK(runs == (keeps ? 0 : 2));
    others.make_missing(results, std::vector<double>(6, 1), 3, make, run, {});
    CHECK(runs == (keeps ? 2 : 4));
  }
}

TEST_CASE("A result is named by all that it is a function of, one after the other") {
  using named = kept<byte_buffer>;
  const std::vector<double> some{1, 2}, none;
  CHECK(named::of(1, some) == named::of(1, some));
  CHECK(named::of(1, some) != named::of(2, some));
  CHECK(named::of(some, none) != named::of(none, some));
  CHECK(named::of(std::string("ab"), std::string("c")) != named::of(std::string("a"), std::string("bc")));
  CHECK(named() != named::of());
}

TEST_CASE("What is forgotten is removed from the disk; in memory others may have it") {
  const testing::scratch_folder scratch("batches");
  const kept<byte_buffer> result = kept<byte_buffer>::of(7), other = kept<byte_buffer>::of(8);
  for (const bool on_disk : {true, false}) {
    const any_executor run =
        on_disk ? any_executor(parallel::checkpointed(parallel::serial{}, spool::start(scratch, identity)))
                : any_executor(parallel::remembering(parallel::serial{}));
    const auto store = store_of(run, "batches");
    for (const auto& each : {result, other})
      store->keep(each.key(), bytes_of(3));
    forget(run, "batches", std::set{result});
    CHECK(store->find(result.key()).has_value() != on_disk);
    CHECK(store->find(other.key()).has_value());
    CHECK((lasting_store_of(run, "batches") == store) == on_disk);
    CHECK(any_executor(parallel::forgetting(run)).results() == nullptr);
  }
}
