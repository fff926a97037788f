/// @file
/// Ctrl-C as a request to stop at the next safe point.
#pragma once

#include <vector>

namespace dovetail::app {

/// SIGINT and SIGTERM; SIGHUP and SIGQUIT unless they were ignored from the start, as under nohup.
std::vector<int> stop_signals();

/// From now on these only set a flag; who does not look at it is ended by `run_supervised`.
void catch_stop_signals();

/// Whether one has come.
bool stop_was_requested();

} // namespace dovetail::app
