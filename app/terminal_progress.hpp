/// @file
/// One line per stage on the terminal: how far, how fast, how long still.
#pragma once

#include "dovetail/core/progress.hpp"

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

namespace dovetail::app {

/// Writes a line per stage. On a terminal the line is rewritten in place; elsewhere (a file, a pipe) one
/// plain line is written when a stage ends, and one every ten seconds while it lasts.
class terminal_progress {
public:
  explicit terminal_progress(std::FILE* stream);
  terminal_progress(const terminal_progress&) = delete;
  terminal_progress& operator=(const terminal_progress&) = delete;
  ~terminal_progress() { finish(); }

  void update(std::string_view stage, std::size_t done, std::size_t total);

  /// Ends the line of the stage under way.
  void finish();

  /// Callbacks for the library that report here and stop on Ctrl-C. Valid as long as this object.
  progress callbacks();

private:
  using clock = std::chrono::steady_clock;

  void start(std::string_view stage);
  void write(bool last);

  std::FILE* stream_;
  bool in_place_;
  std::string stage_;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  clock::time_point started_;
  clock::time_point written_;
  std::size_t width_ = 0; ///< of the line last written in place
};

/// Seconds as "0.42 s", "12.3 s", "3 min 05 s" or "2 h 10 min".
std::string duration_text(double seconds);

/// A count as "950", "12.3 k" or "4.56 M".
std::string count_text(double count);

} // namespace dovetail::app
