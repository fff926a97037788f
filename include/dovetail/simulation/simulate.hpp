/// @file
/// How long a run would take on a machine with many workers: discrete events, with one manager who deals the
/// tasks by request, as `parallel::ranks` does.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/simulation/workload.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::simulation {

/// Times are seconds, the bandwidth is in bytes per second. The defaults are of a network of its time: 2
/// microseconds, 10 gigabytes per second.
struct simulated_machine {
  std::int64_t workers = 1;
  std::int64_t cores = 0;        ///< that they share; 0: one for each
  double latency = 2e-6;         ///< of a message
  double bandwidth = 1e10;       ///< of each link
  double request_seconds = 5e-6; ///< the manager's work for a result and the next grant
  int granted_ahead = 2;         ///< tasks that a worker has, the one it is at included
};

struct simulated_times {
  std::string stage;
  double alone = 0;    ///< in which workers wait for one process, or all do the same
  double tasks = 0;    ///< from the first grant to the last result at all ranks
  double busy = 0;     ///< of all workers together
  double idle = 0;     ///< the rest of the workers' time in `tasks`
  double managing = 0; ///< of the manager, within `tasks`
};

struct simulated_run {
  std::vector<simulated_times> stages = {};
  double seconds = 0;
};

namespace detail {

/// One batch: the tasks in their order, to whoever asks first. O(tasks log workers)
class batch_simulation {
public:
  batch_simulation(const std::vector<simulated_task>& tasks, const simulated_machine& machine)
      : tasks_(tasks), machine_(machine),
        slowdown_(machine.cores == 0
                      ? 1.0
                      : std::max(1.0, static_cast<double>(std::min<std::int64_t>(
                                          machine.workers, static_cast<std::int64_t>(tasks.size()))) /
                                          static_cast<double>(machine.cores))),
        free_(static_cast<std::size_t>(
                  std::min<std::int64_t>(machine.workers, static_cast<std::int64_t>(tasks.size()))),
              0.0) {}

  void add_to(simulated_times& times) {
    for (int ahead = 0; ahead < machine_.granted_ahead; ++ahead)
      for (std::size_t w = 0; w < free_.size(); ++w)
        grant(w);
    double bytes = 0;
    while (!arrivals_.empty()) {
      const auto [time, worker] = arrivals_.top();
      arrivals_.pop();
      manager_ = std::max(manager_, time);
      grant(worker);
    }
    for (const simulated_task& task : tasks_)
      bytes += task.bytes;
    const double hops =
        std::ceil(std::log2(static_cast<double>(std::max<std::int64_t>(machine_.workers, 1))));
    const double told = machine_.workers > 1 ? bytes / machine_.bandwidth + hops * machine_.latency : 0;
    times.tasks += manager_ + told;
    times.busy += busy_;
    times.idle += static_cast<double>(machine_.workers) * (manager_ + told) - busy_;
    times.managing += managing_;
  }

private:
  using arrival = std::pair<double, std::size_t>; ///< of a result of a worker at the manager

  void grant(std::size_t worker) {
    manager_ += machine_.request_seconds;
    managing_ += machine_.request_seconds;
    if (next_ == tasks_.size())
      return;
    const simulated_task& task = tasks_[next_++];
    double& free = free_[worker];
    free = std::max(free, manager_ + machine_.latency) + task.seconds * slowdown_;
    busy_ += task.seconds * slowdown_;
    arrivals_.emplace(free + machine_.latency + task.bytes / machine_.bandwidth, worker);
  }

  const std::vector<simulated_task>& tasks_;
  const simulated_machine& machine_;
  double slowdown_;
  std::vector<double> free_; ///< when each worker is done with what it has
  std::priority_queue<arrival, std::vector<arrival>, std::greater<>> arrivals_ = {};
  std::size_t next_ = 0;
  double manager_ = 0;
  double managing_ = 0;
  double busy_ = 0;
};

} // namespace detail

/// Throws `usage_error` for a machine that cannot be.
inline simulated_run simulate(const workload& work, const simulated_machine& machine) {
  if (machine.workers < 1 || machine.cores < 0 || machine.granted_ahead < 1 || !(machine.latency >= 0) ||
      !(machine.bandwidth > 0) || !(machine.request_seconds >= 0))
    throw usage_error("a simulated machine needs workers, a bandwidth, and times that are not negative");
  simulated_run run;
  for (const simulated_stage& stage : work.stages) {
    simulated_times& times = run.stages.emplace_back(simulated_times{stage.stage});
    times.alone = stage.seconds_alone;
    for (const auto& batch : stage.batches)
      detail::batch_simulation(batch, machine).add_to(times);
    run.seconds += times.alone + times.tasks;
  }
  return run;
}

/// The stage that takes most of a run, alone or by its tasks. Throws `usage_error` for a run without stages.
inline const simulated_times& bottleneck(const simulated_run& run) {
  if (run.stages.empty())
    throw usage_error("a run without stages has no bottleneck");
  return *std::max_element(run.stages.begin(), run.stages.end(),
                           [](const simulated_times& a, const simulated_times& b) {
                             return a.alone + a.tasks < b.alone + b.tasks;
                           });
}

} // namespace dovetail::simulation
