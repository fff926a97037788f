/// @file
/// What `threads.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/run_task.hpp"
#include "dovetail/parallel/threads.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace dovetail::parallel {

DOVETAIL_INLINE std::vector<task_outcome> threads::run(std::size_t count, const task_function& task,
                                                       const run_options& options) const {
  const auto order = detail::start_order(count, options);
  std::vector<task_outcome> outcomes(count);
  std::mutex mutex; // guards the outcomes and what follows
  std::condition_variable finished;
  std::size_t next = 0;
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
      finished.wait_for(lock, std::chrono::milliseconds(100), [&] { return done != reported; });
      const std::size_t now = done;
      lock.unlock();
      if (now != reported)
        options.on_progress(options.stage, now, count);
      else
        options.on_progress.stop_if_requested();
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

} // namespace dovetail::parallel
