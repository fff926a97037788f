/// @file
/// The executor that runs tasks in threads of this process.
#pragma once

#include "dovetail/parallel/run_task.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor` for tasks that may run side by side in one process; TetGen and Gmsh may not. A task
/// that crashes ends the process, and one that hangs is not interrupted.
struct threads {
  int worker_count = 0; ///< 0: one per hardware thread

  int workers() const {
    return worker_count > 0 ? worker_count
                            : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  bool shares_process() const { return true; }

  /// Progress is reported from the calling thread; a stop takes effect when the running tasks have ended.
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options = {}) const;
};

inline std::vector<task_outcome> threads::run(std::size_t count, const task_function& task,
                                              const run_options& options) const {
  const auto order = detail::start_order(count, options);
  std::vector<task_outcome> outcomes(count);
  std::mutex mutex;
  std::condition_variable finished;
  std::size_t next = 0; // all three guarded by the mutex
  std::size_t done = 0;
  bool stopped = false;

  const auto work = [&] {
    std::unique_lock lock(mutex);
    while (next < count && !stopped) {
      const std::size_t index = order[next++];
      lock.unlock();
      task_outcome outcome = detail::run_task(task, index);
      lock.lock();
      outcomes[index] = std::move(outcome);
      ++done;
      finished.notify_one();
    }
  };
  const auto report_until_done = [&] {
    std::size_t reported = 0;
    options.on_progress(options.stage, 0, count);
    std::unique_lock lock(mutex);
    while (reported < count) {
      finished.wait_for(lock, std::chrono::milliseconds(100));
      const std::size_t now = done;
      lock.unlock();
      if (now != reported)
        options.on_progress(options.stage, now, count);
      else
        detail::stop_if_requested(options.on_progress);
      reported = now;
      lock.lock();
    }
  };

  std::vector<std::thread> pool;
  const auto join_all = [&] {
    for (std::thread& thread : pool)
      thread.join();
  };
  try {
    for (std::size_t k = 0; k < std::min(count, static_cast<std::size_t>(workers())); ++k)
      pool.emplace_back(work);
    report_until_done();
  } catch (...) {
    {
      const std::lock_guard lock(mutex);
      stopped = true;
    }
    join_all();
    throw;
  }
  join_all();
  return outcomes;
}

static_assert(executor<threads>);

} // namespace dovetail::parallel
