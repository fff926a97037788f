/// @file
/// What every executor must do; each model's test calls this.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace contract {

using namespace dovetail;

inline byte_buffer encoded(std::size_t number) {
  byte_writer writer;
  writer.value<std::uint64_t>(number);
  return writer.take();
}
inline std::size_t decoded(const byte_buffer& bytes) {
  byte_reader reader(bytes);
  return static_cast<std::size_t>(reader.value<std::uint64_t>());
}

/// Results land where their tasks belong, whatever the order they are started in.
template <class E>
void check_results(const E& executor) {
  run_options backwards;
  backwards.order.resize(1000);
  std::iota(backwards.order.rbegin(), backwards.order.rend(), std::size_t{0});
  const task_function square = [](std::size_t i) { return encoded(i * i); };
  for (const run_options& options : {run_options{}, backwards}) {
    const auto outcomes = executor.run(1000, square, options);
    REQUIRE(outcomes.size() == 1000);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      REQUIRE(outcomes[i].ok);
      REQUIRE(decoded(outcomes[i].result) == i * i);
    }
  }
  CHECK(executor.run(0, square, {}).empty());
}

template <class E>
void check_order_is_validated(const E& executor) {
  const task_function nothing = [](std::size_t) { return byte_buffer{}; };
  for (const auto& order :
       std::vector<std::vector<std::size_t>>{{0, 1}, {0, 1, 1}, {0, 1, 3}, {0, 1, 2, 3}}) {
    run_options options;
    options.order = order;
    CHECK_THROWS_AS(executor.run(3, nothing, options), usage_error);
  }
}

/// A task that throws fails alone, with the exception's text; a time limit within it counts as its own.
template <class E>
void check_exceptions(const E& executor) {
  const auto outcomes = executor.run(9,
                                     [](std::size_t i) -> byte_buffer {
                                       if (i == 7)
                                         throw time_limit_error("seven");
                                       if (i == 3)
                                         throw std::runtime_error("three");
                                       if (i == 5)
                                         throw 5;
                                       return encoded(i);
                                     },
                                     {});
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    CHECK(outcomes[i].ok == (i != 3 && i != 5 && i != 7));
    CHECK_FALSE(outcomes[i].crashed);
    CHECK(outcomes[i].timed_out == (i == 7));
  }
  CHECK(outcomes[3].failure == "three");
  CHECK_FALSE(outcomes[5].failure.empty());
}

/// Progress runs from 0 to all, and a stop ends in `cancelled`.
template <class E>
void check_progress_and_stop(const E& executor) {
  std::vector<std::size_t> seen;
  run_options options;
  options.stage = "counting";
  options.on_progress.update = [&](std::string_view stage, std::size_t done, std::size_t total) {
    CHECK(stage == "counting");
    CHECK(total == 20);
    seen.push_back(done);
  };
  const task_function task = [](std::size_t i) { return encoded(i); };
  executor.run(20, task, options);
  CHECK(seen.front() == 0);
  CHECK(seen.back() == 20);
  CHECK(std::is_sorted(seen.begin(), seen.end()));

  run_options stopping;
  int asked = 0;
  // Every executor reports the start and the end at least, however fast the tasks are.
  stopping.on_progress.stop_requested = [&] { return ++asked > 1; };
  CHECK_THROWS_AS(executor.run(100000, task, stopping), cancelled);
}

/// Large results arrive whole, several at a time.
template <class E>
void check_large_results(const E& executor, std::size_t size) {
  const auto outcomes = executor.run(4,
                                     [size](std::size_t i) {
                                       byte_buffer bytes(size + i, static_cast<std::byte>(i));
                                       bytes[size / 2] = std::byte{77};
                                       return bytes;
                                     },
                                     {});
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    REQUIRE(outcomes[i].ok);
    const byte_buffer& bytes = outcomes[i].result;
    REQUIRE(bytes.size() == size + i);
    const auto others = std::count(bytes.begin(), bytes.end(), static_cast<std::byte>(i));
    CHECK(static_cast<std::size_t>(others) == bytes.size() - 1);
    CHECK(bytes[size / 2] == std::byte{77});
  }
}

template <class E>
void check_executor(const E& executor, std::size_t large = std::size_t{48} << 20) {
  CHECK(executor.workers() >= 1);
  check_results(executor);
  check_order_is_validated(executor);
  check_exceptions(executor);
  check_progress_and_stop(executor);
  check_large_results(executor, large);
}

} // namespace contract
