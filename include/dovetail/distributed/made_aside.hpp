/// @file
/// A value that a child process makes while this one goes on. Linux.
#pragma once

#include "dovetail/core/encoding.hpp"
#include "dovetail/distributed/process_pool.hpp"
#include "dovetail/distributed/task_board.hpp"
#include "dovetail/distributed/worker_process.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <optional>
#include <poll.h>
#include <utility>

namespace dovetail {

/// What `work()` returns in a child of this process, which has its memory as it is at the start. For what is
/// asked for at the end of a long run, and would let the other processors wait then. Destruction ends a child
/// that is not done.
template <encodable T>
class made_aside {
public:
  template <class Work>
  explicit made_aside(Work work)
      : task_([work = std::move(work)](std::size_t) { return encoded<T>(work()); }),
        tasks_{task_, {0}, detail::task_board(1)} {
    is_started_ = detail::is_only_thread() && worker_.start(tasks_, 1, {});
  }
  made_aside(const made_aside&) = delete;
  made_aside& operator=(const made_aside&) = delete;

  /// Waits for it, once. Nothing when `work` throws, or the child crashes. Where the system refuses a child,
  /// or this process has other threads, the work is done here.
  std::optional<T> wait() {
    if (!is_started_)
      return value_in(detail::run_task(task_, 0));
    while (!worker_.closed()) {
      if (auto reply = worker_.receive())
        return value_in(std::move(reply->outcome));
      pollfd watched{worker_.socket(), POLLIN, 0};
      ::poll(&watched, 1, -1);
    }
    return std::nullopt;
  }

private:
  static std::optional<T> value_in(task_outcome outcome) {
    if (!outcome.ok)
      return std::nullopt;
    return decoded<T>(outcome.result);
  }

  task_function task_;
  detail::shared_tasks tasks_;
  detail::worker_process worker_;
  bool is_started_ = false;
};

} // namespace dovetail
