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
  double alike = 0;    ///< in which all do the same
  double once = 0;     ///< in which all wait for one process, and until they know its result
  double tasks = 0;    ///< from the first grant to the last result at all ranks
  double busy = 0;     ///< of all workers together
  double idle = 0;     ///< the rest of the workers' time in `tasks`
  double managing = 0; ///< of the manager, within `tasks`
};

/// Seconds of a stage.
inline double whole(const simulated_times& times) {
  return times.alike + times.once + times.tasks;
}

struct simulated_run {
  std::vector<simulated_times> stages = {};
  double seconds = 0;
};

namespace detail {

/// By how much workers that share cores are slower, when so many of them work.
inline double slowdown(const simulated_machine& machine, std::int64_t working) {
  return machine.cores == 0
             ? 1.0
             : std::max(1.0, static_cast<double>(working) / static_cast<double>(machine.cores));
}

/// Seconds until all know so many bytes of one.
inline double telling(const simulated_machine& machine, double bytes) {
  return machine.workers > 1
             ? bytes / machine.bandwidth +
                   std::ceil(std::log2(static_cast<double>(machine.workers))) * machine.latency
             : 0;
}

/// One batch: the tasks in their order, to whoever asks first. O(tasks log workers)
class batch_simulation {
public:
  batch_simulation(const std::vector<simulated_task>& tasks, const simulated_machine& machine)
      : tasks_(tasks), machine_(machine),
        working_(std::min<std::int64_t>(machine.workers, static_cast<std::int64_t>(tasks.size()))),
        slowdown_(slowdown(machine, working_)), free_(static_cast<std::size_t>(working_), 0.0) {}

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
    const double told = telling(machine_, bytes);
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
  std::int64_t working_; ///< workers that get a task
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
    times.alike = stage.seconds_alike * detail::slowdown(machine, machine.workers);
    for (const simulated_task& task : stage.once)
      times.once += task.seconds + detail::telling(machine, task.bytes);
    for (const auto& batch : stage.batches)
      detail::batch_simulation(batch, machine).add_to(times);
    run.seconds += whole(times);
  }
  return run;
}

/// The stage that takes most of a run, with all that is done in it. Throws `usage_error` for a run without
/// stages.
inline const simulated_times& bottleneck(const simulated_run& run) {
  if (run.stages.empty())
    throw usage_error("a run without stages has no bottleneck");
  return *std::max_element(
      run.stages.begin(), run.stages.end(),
      [](const simulated_times& a, const simulated_times& b) { return whole(a) < whole(b); });
}

} // namespace dovetail::simulation
