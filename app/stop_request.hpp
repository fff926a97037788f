/// @file
/// Ctrl-C as a request to stop at the next safe point.
#pragma once

namespace dovetail::app {

/// From now on the first SIGINT or SIGTERM only sets a flag; a second one ends the process at once. Worker
/// processes inherit this and finish, or die with their parent.
void catch_stop_signals();

/// Whether one has come.
bool stop_was_requested();

} // namespace dovetail::app
