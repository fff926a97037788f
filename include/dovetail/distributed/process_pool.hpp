/// @file
/// The parent of worker processes. Linux.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/distributed/task_feed.hpp"
#include "dovetail/distributed/worker_process.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <poll.h>
#include <string>
#include <sys/types.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
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

/// Forks a child that ends at once: libraries that start threads when they are loaded, OpenBLAS among them,
/// end these before a process forks (`pthread_atfork`), and start them again when they need them.
inline void end_threads_that_stand_by() {
  const pid_t child = ::fork();
  if (child == 0)
    ::_exit(0);
  while (child > 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

/// Whether this is the only thread. The system lists a thread for a moment after it was joined.
inline bool is_only_thread() {
  if (thread_count() > 1)
    end_threads_that_stand_by();
  constexpr int moments = 50;
  for (int moment = 0; moment < moments; ++moment) {
    if (thread_count() == 1)
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// Throws `usage_error` when this process has other threads.
inline void require_single_thread() {
  if (!is_only_thread())
    throw usage_error(
        "worker processes cannot be forked from a process with " + std::to_string(thread_count()) +
        " threads, as one is that has initialised MPI; end the threads first, or use an executor "
        "and policies that need no child process");
}

/// One run of tasks in worker processes: the parent's loop. A task whose worker is killed is run once more.
/// Whichever way it ends, its workers are killed and reaped.
class process_pool {
public:
  /// All tasks are for this pool, or those that `feed` grants.
  process_pool(std::size_t count, const task_function& task, const run_options& options, std::size_t workers,
               task_feed* feed = nullptr)
      : options_(options), tasks_{task, start_order(count, options), task_board(count)}, feed_(feed),
        outcomes_(count), recorded_(count, false), tried_again_(count, false),
        workers_(std::min(workers, count)) {
    if (feed_ != nullptr)
      tasks_.board.keep_all_back();
  }

  /// By task; those of others are empty.
  std::vector<task_outcome> run() {
    options_.on_progress(options_.stage, 0, outcomes_.size());
    while (!ended()) {
      const std::size_t before = progress_;
      take_granted();
      if (!ended()) { // by what was heard just now
        start_workers();
        wait_for_news();
        collect();
      }
      progress_ = feed_ != nullptr ? feed_->done() : done_;
      if (progress_ != before)
        options_.on_progress(options_.stage, progress_, outcomes_.size());
      else
        options_.on_progress.stop_if_requested();
    }
    return std::move(outcomes_);
  }

private:
  using worker_id = task_board::worker_id;

  bool ended() const {
    return feed_ != nullptr ? done_ == granted_ && feed_->ended() : done_ == outcomes_.size();
  }

  void take_granted() {
    if (feed_ == nullptr)
      return;
    for (const std::size_t place : feed_->granted()) {
      tasks_.board.give_back(place);
      ++granted_;
    }
  }

  void start_workers() {
    bool any_running = !tasks_.board.has_free(); // or nothing to run
    for (std::size_t w = 0; w < workers_.size(); ++w) {
      worker_process& worker = workers_[w];
      any_running = worker.running() ||
                    (tasks_.board.has_free() && worker.start(tasks_, id_of(w), sockets())) || any_running;
    }
    if (!any_running)
      throw usage_error("the system refuses to start a worker process; run with the serial executor");
  }

  static worker_id id_of(std::size_t w) { return static_cast<worker_id>(w + 1); }

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
    for (const int socket : sockets())
      watched.push_back({socket, POLLIN, 0});
    if (feed_ != nullptr && feed_->descriptor() >= 0)
      watched.push_back({feed_->descriptor(), POLLIN, 0});
    const bool seen = feed_ == nullptr || feed_->descriptor() >= 0;
    ::poll(watched.data(), watched.size(), seen ? 100 : 1); // an interrupting signal is as good as news
  }

  void collect() {
    for (std::size_t w = 0; w < workers_.size(); ++w) {
      worker_process& worker = workers_[w];
      if (!worker.running())
        continue;
      record_replies(worker);
      if (worker.closed()) {
        task_outcome death = worker.death();
        if (const auto place = task_of(w); place && worker.was_killed() && !tried_again_[*place]) {
          tried_again_[*place] = true;
          tasks_.board.give_back(*place);
        } else if (place) {
          record(*place, std::move(death));
        }
      } else if (worker.seconds_on_task() > options_.limit_seconds) {
        task_outcome late = worker.give_up(options_.limit_seconds);
        const bool done_after_all = record_replies(worker);
        if (const auto place = task_of(w); place && done_after_all)
          tasks_.board.give_back(*place); // it had just begun the next one
        else if (place)
          record(*place, std::move(late));
      }
    }
  }

  /// Whether there were any.
  bool record_replies(worker_process& worker) {
    bool any = false;
    while (auto reply = worker.receive()) {
      any = true;
      record(reply->place, std::move(reply->outcome));
    }
    return any;
  }

  /// What a worker that has ended was at. O(tasks)
  std::optional<std::size_t> task_of(std::size_t w) const {
    for (std::size_t place = 0; place < recorded_.size(); ++place)
      if (!recorded_[place] && tasks_.board.is_taken_by(id_of(w), place))
        return place;
    return std::nullopt;
  }

  void record(std::size_t place, task_outcome outcome) {
    outcomes_[tasks_.order[place]] = std::move(outcome);
    recorded_[place] = true;
    ++done_;
    if (feed_ != nullptr)
      feed_->finished(place);
  }

  const run_options& options_;
  shared_tasks tasks_;
  task_feed* feed_;
  std::vector<task_outcome> outcomes_;
  std::vector<bool> recorded_;    ///< per place
  std::vector<bool> tried_again_; ///< per place: its worker was killed once
  std::size_t granted_ = 0;
  std::size_t done_ = 0;
  std::size_t progress_ = 0;
  std::vector<worker_process> workers_;
};

} // namespace dovetail::detail
