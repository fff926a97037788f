/// @file
/// What is said of work that failed for want of memory or stack.
#pragma once

#include <string>

namespace dovetail::detail {

/// What failures say that are for want of memory or stack.
inline constexpr const char* out_of_memory = "out of memory";
inline constexpr const char* out_of_stack = "out of stack: allow more of it (ulimit -s)";
inline constexpr const char* killed_for_memory = ", perhaps for want of memory";

/// Whether a reason says so: nothing is wrong with what the task was given then.
inline bool is_for_want_of_room(const std::string& reason) {
  for (const char* text : {out_of_memory, out_of_stack, killed_for_memory})
    if (reason.find(text) != std::string::npos)
      return true;
  return false;
}

} // namespace dovetail::detail
