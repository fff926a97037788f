/// @file
/// What code that should refuse its input says.
#pragma once

#include <doctest/doctest.h>

#include <string>

namespace dovetail::testing {

/// The message of the error that a call throws; another kind of error is passed on; `otherwise` when there is
/// none.
template <class Error, class Call>
std::string refusal_of(const Call& call, const char* otherwise = "accepted") {
  try {
    (void)call();
  } catch (const Error& problem) {
    return problem.what();
  }
  return otherwise;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Shows the message where the part is missing.
inline bool has(const std::string& message, const std::string& part) {
  const bool found = contains(message, part);
  if (!found)
    MESSAGE("message: ", message);
  return found;
}

} // namespace dovetail::testing
