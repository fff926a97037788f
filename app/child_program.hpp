/// @file
/// Another program, run to its end.
#pragma once

#include <string>
#include <vector>

namespace dovetail::app {

/// Runs a program, its name first, looked for as a shell does, and returns its exit code; `exit_failure`
/// where it could not be started or a signal ended it. A request to stop is passed on, and it ends with
/// this process. `errors`: a file that its error stream goes to; empty: that of this process.
int run_program(const std::vector<std::string>& words, const std::string& errors = "");

} // namespace dovetail::app
