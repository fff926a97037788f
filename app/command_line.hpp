/// @file
/// The command line of the driver.
#pragma once

namespace dovetail::app {

/// Parses the command line, runs the command it names, and returns the exit code.
int run_command_line(int argc, char** argv);

} // namespace dovetail::app
