#include "dovetail/core/error.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/parallel/batched_entities.hpp"
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
std::vector<byte_buffer> make_of(std::span<const content_key> keys, const std::vector<std::size_t>& wanted) {
  std::vector<byte_buffer> made;
  for (const std::size_t i : wanted)
    made.push_back(bytes_of(keys[i].value));
  return made;
}
std::vector<content_key> keys_from(std::uint64_t first, std::uint64_t count) {
  std::vector<content_key> keys;
  for (std::uint64_t k = first; k < first + count; ++k)
    keys.push_back({k});
  return keys;
}

/// Makes what is missing of `keys`, three to a task, and checks all of them.
std::size_t make_and_check(batched_entities<byte_buffer>& entities, const std::vector<content_key>& keys,
                           const any_executor& run) {
  const std::size_t before = entities.made();
  const auto failures = entities.make_missing(
      keys, std::vector<double>(keys.size(), 1), 3,
      [&](const std::vector<std::size_t>& wanted) { return make_of(keys, wanted); }, run, {});
  CHECK(failures.empty());
  std::size_t next = 0;
  entities.for_each(keys, [&](std::size_t i, const byte_buffer& bytes) {
    CHECK(i == next++);
    CHECK(bytes == bytes_of(keys[i].value));
  });
  CHECK(next == keys.size());
  return entities.made() - before;
}

const std::vector<any_executor> kinds_of_executor{parallel::serial{}, parallel::threads{3},
                                                  parallel::processes{3}};

} // namespace

TEST_CASE("What is there is not made again, in memory and on disk, whoever runs the tasks") {
  for (const any_executor& run : kinds_of_executor)
    for (const bool on_disk : {false, true}) {
      const testing::scratch_folder scratch("batches");
      const auto store = on_disk ? std::make_shared<entity_store>(spool::start(scratch, identity))
                                 : std::make_shared<entity_store>();
      batched_entities<byte_buffer> entities(store);
      CHECK(make_and_check(entities, keys_from(10, 20), run) == 20);
      CHECK(make_and_check(entities, keys_from(10, 20), run) == 0);
      CHECK(make_and_check(entities, keys_from(5, 20), run) == 5);
      CHECK(make_and_check(entities, {}, run) == 0);
    }
}

TEST_CASE("A resumed run finds the batches of the earlier one") {
  const testing::scratch_folder scratch("batches");
  const auto keys = keys_from(1, 10);
  batched_entities<byte_buffer> first(std::make_shared<entity_store>(spool::start(scratch, identity)));
  make_and_check(first, keys, parallel::processes{2});
  std::atomic<int> made = 0;
  batched_entities<byte_buffer> second(std::make_shared<entity_store>(spool::resume(scratch, identity)));
  const auto again = [&](const std::vector<std::size_t>& wanted) {
    made += static_cast<int>(wanted.size());
    return make_of(keys, wanted);
  };
  CHECK(second.make_missing(keys, std::vector<double>(10, 1), 3, again, parallel::serial{}, {}).empty());
  CHECK(made == 0);
  CHECK(second.made() == 0);
  second.for_each(keys,
                  [&](std::size_t i, const byte_buffer& bytes) { CHECK(bytes == bytes_of(keys[i].value)); });
}

TEST_CASE("An entity is made once per batch of its cost, the costliest batch first") {
  const auto keys = keys_from(0, 6);
  const std::vector<double> costs{1, 1, 1, 9, 1, 1};
  std::vector<std::vector<std::size_t>> batches;
  batched_entities<byte_buffer> entities(std::make_shared<entity_store>());
  entities.make_missing(keys, costs, 3,
                        [&](const std::vector<std::size_t>& wanted) {
                          batches.push_back(wanted);
                          return make_of(keys, wanted);
                        },
                        parallel::serial{}, {});
  CHECK(batches == std::vector<std::vector<std::size_t>>{{3}, {0, 1, 2}, {4, 5}});
}

TEST_CASE("Of batches that fail, the entities that fail alone are named; a crash too. The others go on") {
  const auto keys = keys_from(0, 9);
  for (const bool crashes : {false, true}) {
    batched_entities<byte_buffer> entities(std::make_shared<entity_store>());
    const auto make_all = [&](std::span<const content_key> wanted_keys, bool faulty) {
      return entities.make_missing(wanted_keys, std::vector<double>(wanted_keys.size(), 1), 3,
                                   [&](const std::vector<std::size_t>& wanted) {
                                     for (const std::size_t i : wanted)
                                       if (faulty && i == 4 && crashes)
                                         std::raise(SIGKILL);
                                       else if (faulty && (i == 1 || i == 4))
                                         throw mesher_error(std::to_string(i) + " fails");
                                     return make_of(keys, wanted);
                                   },
                                   parallel::processes{2}, {});
    };
    const auto failures = make_all(keys, true);
    REQUIRE(failures.size() == 2);
    CHECK(failures[0].entity == 1);
    CHECK(failures[0].reason.find("1 fails") != std::string::npos);
    CHECK(failures[1].entity == 4);
    CHECK(failures[1].reason.find(crashes ? "signal 9" : "4 fails") != std::string::npos);
    CHECK(entities.made() == 7); // the third batch, and what can be made alone of the others
    CHECK(make_all(keys, false).empty());
    CHECK(entities.made() == 9);
  }
}

TEST_CASE("No member of a batch is blamed for what only all of them together do") {
  const auto keys = keys_from(0, 9);
  for (const any_executor& run : {any_executor(parallel::serial{}), any_executor(parallel::processes{1}),
                                  any_executor(parallel::processes{4})}) {
    batched_entities<byte_buffer> entities(std::make_shared<entity_store>());
    const auto not_together = [&](const std::vector<std::size_t>& wanted) {
      if (wanted.size() > 1)
        throw mesher_error("too much for one task");
      if (wanted.front() == 5)
        throw mesher_error("5 fails");
      return make_of(keys, wanted);
    };
    const auto failures = entities.make_missing(keys, std::vector<double>(9, 1), 3, not_together, run, {});
    REQUIRE(failures.size() == 1);
    CHECK(failures[0].entity == 5);
    CHECK(failures[0].reason == "5 fails");
    CHECK(entities.made() == 8);
    const auto only_it = [&](const std::vector<std::size_t>& wanted) {
      CHECK(wanted == std::vector<std::size_t>{5});
      return make_of(keys, wanted);
    };
    CHECK(entities.make_missing(keys, std::vector<double>(9, 1), 3, only_it, parallel::serial{}, {}).empty());
    entities.for_each(
        keys, [&](std::size_t i, const byte_buffer& bytes) { CHECK(bytes == bytes_of(keys[i].value)); });
  }
}

TEST_CASE("A blob that has gone is an error that names it") {
  const testing::scratch_folder scratch("batches");
  const auto disk = spool::start(scratch, identity);
  const auto keys = keys_from(1, 3);
  batched_entities<byte_buffer> entities(std::make_shared<entity_store>(disk));
  make_and_check(entities, keys, parallel::serial{});
  disk.clear();
  CHECK_THROWS_AS(entities.for_each(keys, [](std::size_t, const byte_buffer&) {}), io_error);
}

TEST_CASE("What no other attempt mends is thrown as what it is, and nothing is made twice") {
  const auto keys = keys_from(1, 9);
  for (const any_executor& run : kinds_of_executor) {
    const testing::scratch_folder scratch("batches");
    const auto disk = spool::start(scratch, identity);
    batched_entities<byte_buffer> entities(std::make_shared<entity_store>(disk));
    disk.clear(); // no folder to write to
    CHECK_THROWS_AS(make_and_check(entities, keys, run), io_error);
    batched_entities<byte_buffer> others(std::make_shared<entity_store>());
    const auto no_size = [](const std::vector<std::size_t>&) -> std::vector<byte_buffer> {
      throw sizing_error("the size is 0");
    };
    CHECK_THROWS_WITH_AS(others.make_missing(keys, std::vector<double>(9, 1), 3, no_size, run, {}),
                         "the size is 0", sizing_error);
  }
}
