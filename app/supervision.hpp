/// @file
/// A command runs in a child process: whatever becomes of that, this one ends in time and cleans up.
#pragma once

#include "failure.hpp"

#include "dovetail/parallel/owned_descriptor.hpp"

#include <chrono>
#include <csignal>
#include <functional>
#include <string>

#include <sys/resource.h>
#include <sys/types.h>

namespace dovetail::app {

/// Runs a command in a child and returns its exit code. The first SIGINT or SIGTERM (or what else is
/// in `stop_signals`) asks the child to stop at the next safe point; a second one, or a second without one,
/// ends it and its workers at once (`exit_stopped`). A child that a signal ends, a crash inside a library for
/// example, is one line on the error stream and `exit_failure`. Where a child was stopped or did not end by
/// itself, `clean_up` is called when all its processes are gone, since a worker may leave part of a file; it
/// returns whether another run can go on from what is left, which `stopped` puts into words. Where there is a
/// `spare_process` the command goes on after it was killed. Call it from a process without threads.
int run_supervised(const std::function<int()>& command, const std::function<bool()>& clean_up,
                   const std::function<std::string(bool)>& stopped = stopped_line);

/// Forks a child, and is its parent's side: from then on there are two processes in the program. Made in a
/// process without threads. The parent gets the stop signals here alone.
class supervisor {
public:
  supervisor();
  supervisor(const supervisor&) = delete;
  supervisor& operator=(const supervisor&) = delete;
  ~supervisor();

  /// Whether this is the parent; otherwise it is the child, or there can be none.
  bool supervises() const { return child_ > 0; }
  bool has_no_child() const { return child_ < 0; }
  pid_t child() const { return child_; }

  /// Looks after the child, for so long (less than a second) or until there is something to see to. Where
  /// `passes_on()` is false, the child is not told of a request to stop that comes.
  bool has_ended(
      std::chrono::microseconds at_most, const std::function<bool()>& passes_on = [] { return true; });
  /// As a signal does, the first that comes.
  void ask_to_stop();
  bool is_asked_to_stop() const { return asked_to_stop_; }
  /// Ends the child, if it does not end by itself soon.
  void end_soon();
  /// Ends the child now.
  void end();

  /// Once it has ended: whether it was ended from here; by a signal; its exit code; what a signal means.
  bool ended() const { return ended_; }
  bool was_killed() const;
  int code() const;
  std::string killed_line() const;
  /// Its workers end with it, and are this process's children then. Waits for that, at most some seconds,
  /// since a library may have started children too.
  void await_workers() const;

private:
  void request();
  bool goes_on_in_spare();

  pid_t child_ = -1;
  detail::owned_descriptor call_; ///< a byte is for the spare process to go on, its end for it to end
  int status_ = 0;
  bool over_ = false;
  sigset_t signals_{};
  sigset_t before_{};
  bool requested_ = false;
  bool asked_to_stop_ = false;
  bool ended_ = false;
  std::chrono::steady_clock::time_point since_{};
};

/// This process is killed when its parent ends, or has ended; or not any more.
void end_with_parent(pid_t parent);
void end_without_parent();

/// While it lives, a process under supervision can be killed (SIGKILL) by others, and the command goes on:
/// what comes after its constructor is begun again in another process, once. That one is forked here, since
/// the parent may have threads by now. Nothing may be written or sent meanwhile. Made in a process without
/// threads.
class spare_process {
public:
  spare_process();
  spare_process(const spare_process&) = delete;
  spare_process& operator=(const spare_process&) = delete;
  ~spare_process();

private:
  pid_t process_ = -1; ///< where there is one
};

/// What `clean_up` returns. Whatever goes wrong in it, the supervisor still says how the command ended.
bool cleaned_up(const std::function<bool()>& clean_up) noexcept;

/// While it lives, a crash of the process under supervision is told as "<what> crashed; <advice>", and so
/// many more seconds of processor time end it as "<what> is not done after ...; <advice>", unless the limit
/// that was there comes first or none can be set. One at a time.
class risky_step {
public:
  risky_step(const std::string& what, const std::string& advice, double seconds);
  risky_step(const risky_step&) = delete;
  risky_step& operator=(const risky_step&) = delete;
  ~risky_step();

private:
  bool limit(double seconds);

  rlimit before_{};
  bool limited_ = false;
};

} // namespace dovetail::app
