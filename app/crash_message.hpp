/// @file
/// One clear line when a library crashes on a damaged file.
#pragma once

#include <string>

namespace dovetail::app {

/// While it lives, a crash of this process (a bad access, an overflow of the stack, an abort) writes
/// "dovetail: <text>" on the error stream and ends with `exit_failure`. At most one lives at a time.
class crash_message {
public:
  explicit crash_message(const std::string& text);
  crash_message(const crash_message&) = delete;
  crash_message& operator=(const crash_message&) = delete;
  ~crash_message();
};

} // namespace dovetail::app
