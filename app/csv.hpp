/// @file
/// Lines of a CSV file (RFC 4180).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail::app {

using text_row = std::vector<std::string>;

/// A field: in quotes when it has to be.
inline std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

inline std::string csv_line(const text_row& fields) {
  std::string line;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    line += k == 0 ? "" : ",";
    line += csv_field(fields[k]);
  }
  return line + '\n';
}

} // namespace dovetail::app
