/// @file
/// Standard streams that whoever started the program has closed, or closes before it ends.
#pragma once

namespace dovetail::app {

/// Opens `/dev/null` in place of the descriptors 0, 1 and 2 that are closed: the next file or socket would
/// get their numbers, and what is printed would go there. To be called first.
void open_closed_streams();

/// A run does not end because its progress is no longer read: who writes then learns it as an error.
void outlive_readers();

} // namespace dovetail::app
