/// @file
/// Ctrl-C as a request to stop at the next safe point.
#pragma once

namespace dovetail::app {

/// From now on SIGINT and SIGTERM only set a flag; who does not look at it is ended by `run_supervised`.
void catch_stop_signals();

/// Whether one has come.
bool stop_was_requested();

} // namespace dovetail::app
