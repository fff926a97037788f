#include "terminal_progress.hpp"

#include "dovetail/core/error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace dovetail::app {
namespace {

/// What a function writes to a stream that is no terminal.
template <class Function>
std::string written_by(Function&& function) {
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  function(file);
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file))
    text += static_cast<char>(c);
  std::fclose(file);
  return text;
}

TEST_CASE("where there is no terminal, one plain line is written per stage, at its end") {
  const std::string text = written_by([](std::FILE* file) {
    terminal_progress lines(file);
    for (std::size_t done = 0; done <= 32; ++done)
      lines.update("meshing", done, 32);
    lines.update("improvement", 0, 0);
  });
  CHECK(text.find('\r') == std::string::npos);
  CHECK(std::count(text.begin(), text.end(), '\n') == 2);
  CHECK(text.find("meshing") == 0);
  CHECK(text.find("32/32") != std::string::npos);
  CHECK(text.find("left") == std::string::npos);
  CHECK(text.find("improvement") > text.find("32/32"));
}

TEST_CASE("a stage that is reported again after another gets a line of its own") {
  const std::string text = written_by([](std::FILE* file) {
    terminal_progress lines(file);
    lines.update("a", 1, 1);
    lines.update("b", 1, 1);
    lines.update("a", 1, 1);
  });
  CHECK(std::count(text.begin(), text.end(), '\n') == 3);
}

TEST_CASE("durations are short and exact enough") {
  CHECK(duration_text(0.123) == "0.12 s");
  CHECK(duration_text(12.34) == "12.3 s");
  CHECK(duration_text(99.94) == "99.9 s");
  CHECK(duration_text(99.96) == "1 min 40 s");
  CHECK(duration_text(185) == "3 min 05 s");
  CHECK(duration_text(7800) == "2 h 10 min");
}

TEST_CASE("counts have three digits and a unit, at every border") {
  CHECK(count_text(0) == "0");
  CHECK(count_text(7) == "7");
  CHECK(count_text(4.126) == "4.13");
  CHECK(count_text(41.26) == "41.3");
  CHECK(count_text(999) == "999");
  CHECK(count_text(1000) == "1.00 k");
  CHECK(count_text(12345) == "12.3 k");
  CHECK(count_text(999499) == "999 k");
  CHECK(count_text(999600) == "1.00 M");
  CHECK(count_text(4.567e6) == "4.57 M");
  CHECK(count_text(1.234e9) == "1.23 G");
}

} // namespace
} // namespace dovetail::app
