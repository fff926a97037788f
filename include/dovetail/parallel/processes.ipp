/// @file
/// What `processes.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/processes.hpp"
#include "dovetail/parallel/run_task.hpp"
#include "dovetail/parallel/worker_process.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <poll.h>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace dovetail::detail {

/// Number of threads of this process; 1 when the system does not tell.
inline std::size_t thread_count() {
  std::error_code failed;
  std::size_t count = 0;
  for (std::filesystem::directory_iterator it("/proc/self/task", failed), end; !failed && it != end;
       it.increment(failed))
    ++count;
  return std::max<std::size_t>(count, 1);
}

/// One run of `processes`: the parent's loop. Whichever way it ends, its workers are killed and reaped.
class process_pool {
public:
  process_pool(std::size_t count, const task_function& task, const run_options& options, std::size_t workers)
      : task_(task), options_(options), outcomes_(count), waiting_(start_order(count, options)),
        workers_(std::min(workers, count)) {}

  std::vector<task_outcome> run() {
    options_.on_progress(options_.stage, 0, outcomes_.size());
    while (done_ < outcomes_.size()) {
      hand_out();
      wait_for_news();
      const std::size_t before = done_;
      collect();
      if (done_ != before)
        options_.on_progress(options_.stage, done_, outcomes_.size());
      else
        stop_if_requested(options_.on_progress);
    }
    return std::move(outcomes_);
  }

private:
  void hand_out() {
    bool any_running = false;
    for (worker_process& worker : workers_) {
      if (next_ == waiting_.size())
        return;
      if (worker.busy() || (!worker.running() && !worker.start(task_, sockets()))) {
        any_running = any_running || worker.running();
        continue;
      }
      worker.assign(waiting_[next_++]);
      any_running = true;
    }
    if (!any_running)
      throw usage_error("the system refuses to start a worker process; run with the serial executor");
  }

  std::vector<int> sockets() const {
    std::vector<int> open;
    for (const worker_process& worker : workers_)
      if (worker.running())
        open.push_back(worker.socket());
    return open;
  }

  /// Sleeps until a worker sends something, at most a tenth of a second.
  void wait_for_news() const {
    std::vector<pollfd> watched;
    for (const worker_process& worker : workers_)
      if (worker.busy())
        watched.push_back({worker.socket(), POLLIN, 0});
    ::poll(watched.data(), watched.size(), 100); // an interrupting signal is as good as news
  }

  void collect() {
    for (worker_process& worker : workers_) {
      if (!worker.busy())
        continue;
      task_outcome outcome;
      const bool ended = worker.receive(outcome);
      if (!ended && worker.seconds_on_task() <= options_.limit_seconds)
        continue;
      if (!ended)
        outcome = worker.give_up(options_.limit_seconds);
      if (!outcome.ok)
        worker.end();
      outcomes_[worker.task()] = std::move(outcome);
      ++done_;
    }
  }

  const task_function& task_;
  const run_options& options_;
  std::vector<task_outcome> outcomes_;
  std::vector<std::size_t> waiting_; ///< those before `next_` were handed out
  std::size_t next_ = 0;
  std::size_t done_ = 0;
  std::vector<worker_process> workers_;
};

} // namespace dovetail::detail

namespace dovetail::parallel {

DOVETAIL_INLINE std::vector<task_outcome> processes::run(std::size_t count, const task_function& task,
                                                         const run_options& options) const {
  const std::size_t threads = detail::thread_count();
  if (threads > 1)
    throw usage_error("worker processes cannot be forked from a process with " + std::to_string(threads) +
                      " threads; use the serial or threads executor, or end the threads first");
  if (count == 0)
    return {};
  return detail::process_pool(count, task, options, static_cast<std::size_t>(workers())).run();
}

} // namespace dovetail::parallel
