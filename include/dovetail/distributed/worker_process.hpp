/// @file
/// One forked worker: takes tasks from a board that all share and sends their results over a socket. Linux.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/failure_reasons.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/distributed/stack_overflow.hpp"
#include "dovetail/distributed/task_board.hpp"
#include "dovetail/parallel/owned_descriptor.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dovetail::detail {

/// What a worker sends before the bytes of its result, or of its failure's text.
struct result_header {
  std::uint64_t place;
  std::uint32_t ok;
  std::uint32_t timed_out;
  std::uint64_t size;
  double seconds;
  std::uint64_t peak_rss_bytes;
};

inline std::uint64_t peak_rss_bytes(const rusage& usage) {
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024; // Linux counts KiB
}

/// Writes everything, or returns false when the other end is gone.
inline bool send_all(int socket, const void* data, std::size_t size) {
  const auto* next = static_cast<const std::byte*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(socket, next, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR)
      continue;
    if (sent <= 0)
      return false;
    next += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

/// What all workers of a run know.
struct shared_tasks {
  const task_function& task;
  std::vector<std::size_t> order; ///< the task at each place
  task_board board;
};

/// The life of a worker: until nothing is left, or a task of its fails, so that nothing of the failure
/// reaches another one. Never returns, and never runs what the parent registered for its own exit.
[[noreturn]] inline void serve_tasks(int socket, shared_tasks& tasks, task_board::worker_id self) {
  std::size_t from = 0;
  while (const auto place = tasks.board.take(self, from)) {
    from = *place + 1;
    const task_outcome outcome = run_task(tasks.task, tasks.order[*place]);
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const void* payload =
        outcome.ok ? static_cast<const void*>(outcome.result.data()) : outcome.failure.data();
    const std::size_t size = outcome.ok ? outcome.result.size() : outcome.failure.size();
    const result_header header{*place, outcome.ok,      outcome.timed_out,
                               size,   outcome.seconds, peak_rss_bytes(usage)};
    if (!send_all(socket, &header, sizeof(header)) || !send_all(socket, payload, size) || !outcome.ok)
      break;
  }
  ::_exit(0);
}

/// The exit code of a worker whose stack is used up.
inline constexpr int exit_out_of_stack = 113;

/// A descriptor in place of one that is among those of the standard streams, where a process closed these.
inline int above_standard_streams(int descriptor) {
  if (descriptor < 0 || descriptor > STDERR_FILENO)
    return descriptor;
  const int above = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::close(descriptor);
  return above;
}

/// What the child does before it serves: it dies with its parent, leaves Ctrl-C to the parent, is silent
/// (TetGen prints), and a task that calls exit() skips the parent's exit handlers and buffers.
inline void become_worker(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) // it died before the line above
    ::_exit(0);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  const int null = ::open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::dup2(null, standard);
  if (null > STDERR_FILENO)
    ::close(null);
  on_stack_overflow([] { ::_exit(exit_out_of_stack); });
  ::on_exit([](int status, void*) { ::_exit(status); }, nullptr);
}

/// A worker as its parent sees it. Destruction kills and reaps it.
class worker_process {
public:
  using clock = std::chrono::steady_clock;

  worker_process() = default;
  worker_process(const worker_process&) = delete;
  worker_process& operator=(const worker_process&) = delete;
  ~worker_process() { end(); }

  /// Forks a worker that calls itself `self`. `inherited` are the sockets of the other workers, which this
  /// one must not hold open. Returns false when the system refuses another process.
  bool start(shared_tasks& tasks, task_board::worker_id self, std::span<const int> inherited) {
    end();
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      return false;
    owned_descriptor mine(above_standard_streams(ends[0]));
    owned_descriptor theirs(above_standard_streams(ends[1]));
    if (mine.get() < 0 || theirs.get() < 0)
      return false;
    std::fflush(nullptr); // or the child would hold a second copy of buffered output
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0)
      return false;
    if (child == 0) {
      become_worker(parent);
      mine.close();
      for (const int descriptor : inherited)
        ::close(descriptor);
      serve_tasks(theirs.get(), tasks, self);
    }
    pid_ = child;
    socket_ = std::move(mine);
    closed_ = false;
    since_ = clock::now();
    received_header_ = received_payload_ = 0;
    return true;
  }

  bool running() const { return pid_ > 0; }
  /// Whether the worker has closed its end, with all that it sent received.
  bool closed() const { return closed_; }
  int socket() const { return socket_.get(); }
  double seconds_on_task() const { return std::chrono::duration<double>(clock::now() - since_).count(); }

  struct reply {
    std::size_t place = 0;
    task_outcome outcome;
  };
  /// Takes what has arrived: the next reply, once that is complete.
  std::optional<reply> receive() {
    while (!closed_) {
      const ssize_t got =
          received_header_ < sizeof(header_)
              ? ::recv(socket_.get(), reinterpret_cast<std::byte*>(&header_) + received_header_,
                       sizeof(header_) - received_header_, MSG_DONTWAIT)
              : ::recv(socket_.get(), payload_.data() + received_payload_,
                       payload_.size() - received_payload_, MSG_DONTWAIT);
      if (got < 0 && errno == EINTR)
        continue;
      if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
        return std::nullopt;
      if (got <= 0) {
        closed_ = true;
        return std::nullopt;
      }
      if (received_header_ < sizeof(header_)) {
        received_header_ += static_cast<std::size_t>(got);
        if (received_header_ == sizeof(header_))
          payload_.resize(static_cast<std::size_t>(header_.size));
      } else {
        received_payload_ += static_cast<std::size_t>(got);
      }
      if (received_header_ == sizeof(header_) && received_payload_ == payload_.size())
        return completed();
    }
    return std::nullopt;
  }

  /// Kills the worker because its task takes too long. What it sent before can still be received.
  task_outcome give_up(double limit_seconds) {
    task_outcome outcome;
    outcome.timed_out = true;
    outcome.seconds = seconds_on_task();
    outcome.failure = "exceeded the time limit of " + number_text(limit_seconds) + " s";
    outcome.peak_rss_bytes = kill_and_reap().second;
    return outcome;
  }

  /// What has become of the task of a worker that has closed its socket. One that lives on is killed; a
  /// signal does not change how one ends that already does.
  task_outcome death() {
    task_outcome outcome;
    outcome.crashed = true;
    outcome.seconds = seconds_on_task();
    const auto [status, rss] = kill_and_reap();
    was_killed_ = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
    outcome.peak_rss_bytes = rss;
    if (WIFSIGNALED(status))
      outcome.failure = "the worker was ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                        ::strsignal(WTERMSIG(status)) + ")" + (was_killed_ ? killed_for_memory : "");
    else if (WEXITSTATUS(status) == exit_out_of_stack)
      outcome.failure = out_of_stack;
    else
      outcome.failure = "the worker exited with code " + std::to_string(WEXITSTATUS(status));
    return outcome;
  }

  /// Whether it has died by SIGKILL, which is no doing of its task: the system's, perhaps for want of memory.
  bool was_killed() const { return was_killed_; }

  /// Kills and reaps.
  void end() {
    kill_and_reap();
    socket_.close();
  }

private:
  reply completed() {
    task_outcome outcome;
    outcome.ok = header_.ok != 0;
    outcome.timed_out = header_.timed_out != 0;
    outcome.seconds = header_.seconds;
    outcome.peak_rss_bytes = header_.peak_rss_bytes;
    if (outcome.ok)
      outcome.result = std::move(payload_);
    else
      outcome.failure.assign(reinterpret_cast<const char*>(payload_.data()), payload_.size());
    payload_ = {};
    received_header_ = received_payload_ = 0;
    since_ = clock::now();
    return {static_cast<std::size_t>(header_.place), std::move(outcome)};
  }

  /// How it ended, and the peak memory it reached.
  std::pair<int, std::uint64_t> kill_and_reap() {
    if (pid_ <= 0)
      return {0, 0};
    ::kill(pid_, SIGKILL);
    int status = 0;
    rusage usage{};
    while (::wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return {status, peak_rss_bytes(usage)};
  }

  pid_t pid_ = -1;
  owned_descriptor socket_;
  bool closed_ = false;
  bool was_killed_ = false;
  clock::time_point since_{}; ///< when it was started, or sent its last reply
  result_header header_{};
  std::size_t received_header_ = 0;
  std::size_t received_payload_ = 0;
  byte_buffer payload_;
};

} // namespace dovetail::detail
