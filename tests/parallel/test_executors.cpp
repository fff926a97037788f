#include "dovetail/distributed/processes.hpp"
#include "dovetail/parallel/available_processors.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "parallel/executor_contract.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include <sched.h>

using namespace dovetail;

TEST_CASE("serial is an executor") {
  contract::check_executor(parallel::serial{});
}

TEST_CASE("threads is an executor, whatever the number of workers") {
  for (const int workers : {0, 1, 2, 4}) {
    CAPTURE(workers);
    contract::check_executor(parallel::threads{workers});
  }
}

TEST_CASE("threads runs tasks side by side") {
  std::atomic<int> arrived = 0;
  const auto outcomes = parallel::threads{2}.run(2, [&](std::size_t) {
    ++arrived;
    for (int tries = 0; arrived < 2 && tries < 2000; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return contract::encoded(arrived == 2);
  });
  CHECK(contract::decoded(outcomes[0].result) == 1);
  CHECK(contract::decoded(outcomes[1].result) == 1);
}

TEST_CASE("Executors tell whether tasks share the process with others that run") {
  CHECK_FALSE(runs_in_threads(parallel::serial{}));
  CHECK_FALSE(runs_in_threads(parallel::threads{1}));
  CHECK(runs_in_threads(parallel::threads{2}));
}

TEST_CASE("As many workers as there are processors that may be used, not as the machine has") {
  int bound = 0, forked = 0, threads = 0;
  std::thread([&] { // the binding is of this thread alone
    const int here = ::sched_getcpu();
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(here, &one);
    REQUIRE(::sched_setaffinity(0, sizeof one, &one) == 0);
    bound = parallel::available_processors();
    forked = parallel::processes{}.workers();
    threads = parallel::threads{}.workers();
  })
      .join();
  CHECK(bound == 1);
  CHECK(forked == 1);
  CHECK(threads == 1);
  CHECK(parallel::processes{3}.workers() == 3);
}
