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
  std::string text = "("; // g++ 12 warns of sums of short texts (its bug 105651)
  text.append(number_text(p.x)).append(", ").append(number_text(p.y)).append(", ").append(number_text(p.z));
  return text += ")";
}

} // namespace dovetail
