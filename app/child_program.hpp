/// @file
/// Another program, run to its end.
#pragma once

#include <string>
#include <vector>

namespace dovetail::app {

/// Runs a program, its name first, looked for as a shell does, and returns its exit code; `exit_failure`
/// where it could not be started or a signal ended it. A request to stop is passed on, and it ends with
/// this process. `silent`: its error stream goes nowhere.
int run_program(const std::vector<std::string>& words, bool silent = false);

} // namespace dovetail::app
