/// @file
/// A command runs in a child process: whatever becomes of that, this one ends in time and cleans up.
#pragma once

#include <functional>
#include <string>

#include <sys/resource.h>

namespace dovetail::app {

/// Runs a command in a child and returns its exit code. The first SIGINT or SIGTERM (or what else is
/// in `stop_signals`) asks the child to stop at the next safe point; a second one, or a second without one,
/// ends it and its workers at once
/// (`exit_stopped`). A child that a signal ends, a crash inside a library for example, is one line on the
/// error stream and `exit_failure`. Where a child was stopped or did not end by itself, `clean_up` is called
/// when all its processes are gone, since a worker may leave part of a file; it returns whether another run
/// can go on from what is left. Call it from a process without threads.
int run_supervised(const std::function<int()>& command, const std::function<bool()>& clean_up);

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
