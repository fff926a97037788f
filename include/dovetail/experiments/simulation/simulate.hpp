/// @file
/// How long a run would take on a machine with many workers: discrete events, with one manager who deals the
/// tasks by request, as `parallel::ranks` does.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/experiments/simulation/workload.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <string>
#include <vector>

namespace dovetail::simulation {

/// Times are seconds, the bandwidth is in bytes per second. The defaults are of a network of its time: 2
/// microseconds, 10 gigabytes per second.
struct simulated_machine {
  std::int64_t workers = 1;          ///< of all ranks
  std::int64_t workers_per_rank = 1; ///< at most; a worker of the first rank is also the manager
  std::int64_t cores = 0;  ///< that they share: tasks are run by as many workers at most; 0: one for each
  double turns_cost = 0;   ///< by what fraction each further rank on a core makes its work longer
  double latency = 2e-6;   ///< of a message
  double bandwidth = 1e10; ///< of each worker's link, each way
  double request_seconds = 5e-6; ///< the manager's work for a task that is done and the next grant
  int granted_ahead = 2;         ///< tasks that a worker has, the one it is at included
};

/// The times of a stage.
struct simulated_times {
  std::string stage;   ///< its name
  double alike = 0;    ///< in which all do the same
  double once = 0;     ///< in which all wait for one process, and until they know its result
  double tasks = 0;    ///< from the first grant to the last result at all ranks
  double busy = 0;     ///< of all workers together
  double idle = 0;     ///< the rest of the workers' time in `tasks`
  double managing = 0; ///< of the manager, within `tasks`
  double link = 0;     ///< in which the manager's link is busy, within `once` and `tasks`
};

/// Seconds of a stage.
inline double whole(const simulated_times& times) {
  return times.alike + times.once + times.tasks;
}

/// A simulated run.
struct simulated_run {
  std::vector<simulated_times> stages = {}; ///< in their order
  double seconds = 0;                       ///< of the whole run
};

namespace detail {

/// Bytes of what `any_communicator` and `ranks` send.
struct message_bytes {
  static constexpr double header = 16;        ///< of each message, by `mpi`
  static constexpr double request = header;   ///< it is empty
  static constexpr double grant = header + 8; ///< the number of a task
  static constexpr double outcome = 51;       ///< what goes with each result
  static constexpr double part = 8;           ///< of each rank, where all that they gave is joined
};

inline std::int64_t ranks_of(const simulated_machine& machine) {
  return (machine.workers + machine.workers_per_rank - 1) / machine.workers_per_rank;
}

/// By how much ranks that share cores are slower when all do the same.
inline double slowdown(const simulated_machine& machine) {
  const std::int64_t ranks = ranks_of(machine);
  if (machine.cores == 0 || ranks <= machine.cores)
    return 1;
  const double on_a_core = static_cast<double>(ranks) / static_cast<double>(machine.cores);
  return on_a_core * (1 + machine.turns_cost * (on_a_core - 1));
}

/// All get a message of the manager over a binomial tree: those who have it send it on, one copy after the
/// other, so the manager itself sends as many as there are rounds.
inline double tell(const simulated_machine& machine, double bytes, simulated_times& times) {
  const double rounds = std::ceil(std::log2(static_cast<double>(ranks_of(machine))));
  const double sending = rounds * (message_bytes::header + bytes) / machine.bandwidth;
  times.link += sending;
  return sending + rounds * machine.latency;
}

/// One way of the manager's link: messages are served one after the other.
class shared_link {
public:
  explicit shared_link(const simulated_machine& machine) : machine_(machine) {}

  /// When a message is there that is given to the link at `time`. Calls are by growing times.
  double pass(double time, double bytes) {
    const double seconds = bytes / machine_.bandwidth;
    free_ = std::max(free_, time) + seconds;
    busy_ += seconds;
    return free_ + machine_.latency;
  }
  double busy() const { return busy_; }

private:
  const simulated_machine& machine_;
  double free_ = 0;
  double busy_ = 0;
};

/// One batch. Each worker has some tasks in the beginning, dealt in turn without a word, and asks for another
/// for each that is done. Results stay with their rank until its worker is told that nothing is left; then it
/// sends them to the manager, who tells all of them to all ranks. The manager's own rank needs no messages.
/// O(tasks log workers)
class batch_simulation {
public:
  batch_simulation(const std::vector<simulated_task>& tasks, const simulated_machine& machine)
      : tasks_(tasks), machine_(machine), to_manager_(machine), from_manager_(machine),
        workers_(static_cast<std::size_t>(working())), ranks_(static_cast<std::size_t>(working_ranks())) {
    for (std::size_t w = 0; w < workers_.size(); ++w)
      ++ranks_[rank_of(w)].working;
  }

  void add_to(simulated_times& times) {
    to_manager_.pass(0, static_cast<double>(ranks_of(machine_) - working_ranks()) * message_bytes::header);
    for (int ahead = 0; ahead < machine_.granted_ahead; ++ahead)
      for (std::size_t w = 0; w < workers_.size() && next_ < tasks_.size(); ++w)
        start(w, 0);
    double gathered = 0;
    while (!events_.empty()) {
      const auto [time, worker, is_end] = events_.top();
      events_.pop();
      if (!is_end)
        answer(time, worker);
      else
        gathered = std::max(gathered, ended(time, rank_of(worker)));
    }
    double joined = static_cast<double>(ranks_of(machine_)) * message_bytes::part;
    for (const simulated_task& task : tasks_)
      joined += task.bytes + message_bytes::outcome;
    const double seconds = gathered + tell(machine_, joined, times);
    times.tasks += seconds;
    times.busy += busy_;
    times.idle += static_cast<double>(machine_.workers) * seconds - busy_;
    times.managing += managing_;
    times.link += to_manager_.busy() + from_manager_.busy();
  }

private:
  struct worker_state {
    double free = 0;             ///< when it is done with what it has
    std::int64_t unanswered = 0; ///< tasks, started or done, whose request has no answer yet
  };
  struct rank_state {
    std::int64_t working = 0; ///< of its workers
    double bytes = 0;         ///< of its results
  };
  /// A worker asks for a task, or knows that nothing is left.
  struct event {
    double time;
    std::size_t worker;
    bool is_end;
    friend auto operator<=>(const event&, const event&) = default;
  };

  /// Workers that get a task.
  std::int64_t working() const {
    const auto some = std::min<std::int64_t>(machine_.workers, static_cast<std::int64_t>(tasks_.size()));
    return machine_.cores == 0 ? some : std::min(some, machine_.cores);
  }
  std::int64_t working_ranks() const { return std::min(working(), ranks_of(machine_)); }
  /// The first tasks go to a worker of each rank, the next to a second one of each.
  std::size_t rank_of(std::size_t worker) const {
    return worker % static_cast<std::size_t>(ranks_of(machine_));
  }
  /// A worker of the rank has nothing left; the last one gives the results of all. Returns when the manager
  /// has them.
  double ended(double time, std::size_t rank) {
    rank_state& of = ranks_[rank];
    if (--of.working > 0 || rank == 0)
      return time;
    return to_manager_.pass(time, message_bytes::header + of.bytes);
  }

  void start(std::size_t number, double told) {
    const simulated_task& task = tasks_[next_++];
    worker_state& worker = workers_[number];
    worker.free = std::max(worker.free, told) + task.seconds;
    ++worker.unanswered;
    ranks_[rank_of(number)].bytes += task.bytes + message_bytes::outcome;
    busy_ += task.seconds;
    events_.push({worker.free, number, false});
  }

  void answer(double asked, std::size_t number) {
    const bool is_manager = rank_of(number) == 0;
    manager_ = std::max(manager_, is_manager ? asked : to_manager_.pass(asked, message_bytes::request)) +
               machine_.request_seconds;
    managing_ += machine_.request_seconds;
    const double answered = is_manager ? manager_ : from_manager_.pass(manager_, message_bytes::grant);
    --workers_[number].unanswered;
    if (next_ < tasks_.size())
      start(number, answered);
    else if (workers_[number].unanswered == 0)
      events_.push({answered, number, true});
  }

  const std::vector<simulated_task>& tasks_;
  const simulated_machine& machine_;
  shared_link to_manager_;
  shared_link from_manager_;
  std::vector<worker_state> workers_;
  std::vector<rank_state> ranks_;
  std::priority_queue<event, std::vector<event>, std::greater<>> events_ = {};
  std::size_t next_ = 0;
  double manager_ = 0;
  double managing_ = 0;
  double busy_ = 0;
};

} // namespace detail

/// Throws `usage_error` for a machine that cannot be.
inline simulated_run simulate(const workload& work, const simulated_machine& machine) {
  if (machine.workers < 1 || machine.workers_per_rank < 1 || machine.cores < 0 || machine.granted_ahead < 1 ||
      !(machine.turns_cost >= 0) || !(machine.latency >= 0) || !(machine.bandwidth > 0) ||
      !(machine.request_seconds >= 0))
    throw usage_error("a simulated machine needs workers, a bandwidth, and times that are not negative");
  simulated_run run;
  for (const simulated_stage& stage : work.stages) {
    simulated_times& times = run.stages.emplace_back(simulated_times{stage.stage});
    times.alike = stage.seconds_alike * detail::slowdown(machine);
    for (const simulated_task& task : stage.once)
      times.once += task.seconds + detail::tell(machine, task.bytes, times);
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
