#include "dovetail/core/error.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/common_arrays.hpp"
#include "dovetail/parallel/common_memory.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

using namespace dovetail;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t tasks = 9, numbers_per_task = 1000;

spool new_spool(const fs::path& folder) {
  return spool::start(folder, {{"input", "abc"}});
}
fs::path place_of_file(const spool& disk) {
  return *entity_store(place_in(disk), "common").place_of_file("numbers");
}

/// Task i writes a thousand numbers from 1000 i + `first` on.
void write_numbers(const common_memory& memory, std::size_t task, int first) {
  std::vector<int> numbers(numbers_per_task);
  std::iota(numbers.begin(), numbers.end(), static_cast<int>(task * numbers_per_task) + first);
  memory.write(task * numbers_per_task * sizeof(int), numbers);
}

shared_array<int> filled(const any_executor& run, int first = 0) {
  common_memory memory(run, "numbers", tasks * numbers_per_task * sizeof(int));
  memory.fill(run, tasks, [&](std::size_t i) { write_numbers(memory, i, first); }, {});
  memory.close();
  return memory.array<int>(0, tasks * numbers_per_task);
}

void check_numbers(const shared_array<int>& numbers, int first = 0) {
  REQUIRE(numbers.size() == tasks * numbers_per_task);
  bool right = true;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    right = right && numbers[i] == static_cast<int>(i) + first;
  CHECK(right);
}

} // namespace

TEST_CASE("What tasks write is read by whoever ran them") {
  for (const any_executor& run : {any_executor(parallel::serial{}), any_executor(parallel::threads{3}),
                                  any_executor(parallel::processes{3})}) {
    const shared_array<int> numbers = filled(run);
    check_numbers(numbers);
    shared_array<int> copy = numbers;
    CHECK(copy.data() == numbers.data());
    copy.own()[0] = 7; // as in a vector, without changing the others
    CHECK(copy[0] == 7);
    CHECK(numbers[0] == 0);
    CHECK(copy.size() == numbers.size());
    CHECK_FALSE(copy == numbers);
  }
}

TEST_CASE("Ranks with one spool have it in a file there, of which the next one takes the place") {
  const testing::scratch_folder scratch("common_memory");
  const spool disk = new_spool(scratch / "spool");
  std::array<std::atomic<int>, tasks> times{};
  parallel::run_ranks(3, [&](parallel::in_process& mine) {
    const any_executor run = parallel::checkpointed(parallel::ranks(mine), disk);
    common_memory memory(run, "numbers", tasks * numbers_per_task * sizeof(int));
    memory.fill(run, tasks,
                [&](std::size_t i) {
                  ++times[i];
                  write_numbers(memory, i, 0);
                },
                {});
    memory.close();
    const auto first = memory.array<int>(0, tasks * numbers_per_task);
    check_numbers(first);
    const auto second = filled(run, 5);
    check_numbers(second, 5);
    check_numbers(first); // on one machine the old pages last as long as somebody holds them
  });
  for (const auto& count : times)
    CHECK(count == 1);
  CHECK(fs::file_size(place_of_file(disk)) == tasks * numbers_per_task * sizeof(int));
  new_spool(scratch / "spool"); // as any that starts there
  CHECK_FALSE(fs::exists(place_of_file(disk)));
}

TEST_CASE("Ranks that do not see each other's spools have one each") {
  const testing::scratch_folder scratch("common_memory");
  parallel::run_ranks(2, [&](parallel::in_process& mine) {
    const auto folder = scratch / std::to_string(mine.rank());
    const spool disk = new_spool(folder).of_one_rank();
    check_numbers(filled(parallel::checkpointed(parallel::ranks(mine), disk)));
    CHECK_FALSE(fs::exists(place_of_file(disk)));
  });
}

TEST_CASE("Arrays of several types are filled by ranges") {
  constexpr std::size_t parts = 5, characters = 3; // of a part: an array ends where no double may begin
  for (const any_executor& run : {any_executor(parallel::serial{}), any_executor(parallel::processes{2})}) {
    common_arrays<char, double> arrays(run, "arrays", {parts * characters, parts});
    arrays.fill(run, parts,
                [&](std::size_t i) {
                  arrays.write<0>(i * characters, std::vector<char>(characters, static_cast<char>('a' + i)));
                  arrays.write<1>(i, {0.5 * static_cast<double>(i)});
                },
                {});
    const auto [letters, halves] = arrays.close();
    CHECK(std::string(letters.begin(), letters.end()) == "aaabbbcccdddeee");
    CHECK(std::vector<double>(halves.begin(), halves.end()) == std::vector<double>{0, 0.5, 1, 1.5, 2});
    CHECK(reinterpret_cast<std::uintptr_t>(halves.data()) % alignof(double) == 0);
  }
}

TEST_CASE("A task that fails is told by its stage") {
  const parallel::processes run{2};
  common_memory memory(run, "numbers", tasks * numbers_per_task * sizeof(int));
  const auto crash = [&](std::size_t i) {
    if (i == 4)
      std::raise(SIGABRT);
    write_numbers(memory, i, 0);
  };
  CHECK_THROWS_WITH_AS(memory.fill(run, tasks, crash, {.stage = "skeleton"}),
                       doctest::Contains("skeleton: the worker was ended by signal 6"), mesh_error);
}

TEST_CASE("A file that cannot be made or written is an error on all ranks") {
  const testing::scratch_folder scratch("common_memory");
  const spool disk = new_spool(scratch / "spool");
  parallel::run_ranks(2, [&](parallel::in_process& mine) {
    const any_executor run = parallel::checkpointed(parallel::ranks(mine), disk);
    common_memory memory(run, "numbers", tasks * numbers_per_task * sizeof(int));
    if (leads(run))
      fs::remove(place_of_file(disk));
    run.network().agree();
    CHECK_THROWS_WITH_AS(memory.fill(run, tasks, [&](std::size_t i) { write_numbers(memory, i, 0); }, {}),
                         doctest::Contains("cannot open"), io_error);
    CHECK_THROWS_AS(memory.close(), io_error);
  });
  fs::remove_all(scratch / "spool");
  parallel::run_ranks(2, [&](parallel::in_process& mine) {
    CHECK_THROWS_WITH_AS(filled(parallel::checkpointed(parallel::ranks(mine), disk)),
                         doctest::Contains("common_numbers"), io_error);
  });
}
