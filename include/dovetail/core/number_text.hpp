/// @file
/// Numbers in messages.
#pragma once

#include <cstdio>
#include <string>

namespace dovetail {

/// With so many significant digits, and a power of ten where the number is very large or small.
inline std::string number_text(double number, int digits = 6) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, number);
  return text;
}

} // namespace dovetail
