/// @file
/// Numbers as text with a fixed number of decimals.
#pragma once

#include <cstdio>
#include <string>

namespace dovetail::app {

/// A number with so many decimals.
inline std::string fixed(double number, int decimals = 1) {
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", decimals, number);
  return text;
}

} // namespace dovetail::app
