// What an executor adds to small tasks: as many of 1, 5 and 10 ms, which sleep, by worker processes. The wall
// time of each worker less that of its tasks, per task.
//
//   tasks [tasks, default 10000] [workers, default 2]
#include "dovetail/core/report.hpp"
#include "dovetail/distributed/processes.hpp"

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <thread>

using namespace dovetail;

int main(int argc, char** argv) {
  const auto tasks = static_cast<std::size_t>(argc > 1 ? std::atoi(argv[1]) : 10000);
  const int workers = argc > 2 ? std::atoi(argv[2]) : 2;
  for (const int milliseconds : {1, 5, 10}) {
    const stopwatch clock;
    const auto outcomes = parallel::processes{workers}.run(tasks, [&](std::size_t i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      return byte_buffer(100, static_cast<std::byte>(i));
    });
    const double of_workers = clock.seconds() * workers;
    double of_tasks = 0;
    for (const task_outcome& outcome : outcomes)
      of_tasks += outcome.seconds;
    std::printf("%2d ms: %.1f us per task, %.2f %% of the workers' time\n", milliseconds,
                1e6 * (of_workers - of_tasks) / static_cast<double>(tasks),
                100 * (1 - of_tasks / of_workers));
  }
  return 0;
}
