/// @file
/// Numbers in messages.
#pragma once

#include "dovetail/core/vector.hpp"

#include <cstdio>
#include <string>

namespace dovetail {

/// With so many significant digits, and a power of ten where the number is very large or small.
inline std::string number_text(double number, int digits = 6) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, number);
  return text;
}

/// A point, in brackets.
inline std::string place_text(vec3 p) {
  return "(" + number_text(p.x) + ", " + number_text(p.y) + ", " + number_text(p.z) + ")";
}

} // namespace dovetail
