/// @file
/// How the driver ends: one clear line on the error stream, and an exit code.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace dovetail::app {

enum exit_code : int {
  exit_ok = 0,
  exit_failure = 1, ///< an error of the library; or `check` found faults
  exit_usage = 2,   ///< a wrong command line
  exit_stopped = 130
};

/// A command line that asks for something impossible.
class command_line_error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Runs a command; on an exception says on one line of the error stream what went wrong, and for a command
/// line that is wrong where to find `help`, and returns the exit code. What the command says and cannot be
/// written, as on a full disk, is an error too; but not that nobody reads it any more.
int run_guarded(const std::function<int()>& command, const std::string& help);

/// What a command that was stopped says, and whether another one can go on from what it leaves.
inline std::string stopped_line(bool can_go_on) {
  return can_go_on ? "stopped; --resume goes on from what is kept, if that is of the same command"
                   : "stopped";
}
/// The same of an experiment, which keeps the runs that are finished.
inline std::string stopped_experiment_line(bool) {
  return "stopped; the same command goes on after the runs that are finished";
}

/// Writes "dovetail: <text>" on one line of the error stream.
void complain(const std::string& text);

/// Whether this process has complained, or one that it has forked since `share_complaints`: a child that is
/// ended between its last line and its exit has said enough.
bool has_complained();
void share_complaints();

} // namespace dovetail::app
