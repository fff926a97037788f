#include "terminal_progress.hpp"

#include "stop_request.hpp"

#include <algorithm>
#include <cmath>

#include <unistd.h>

namespace dovetail::app {
namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

} // namespace

terminal_progress::terminal_progress(std::FILE* stream)
    : stream_(stream), in_place_(isatty(fileno(stream))) {}

progress terminal_progress::callbacks() {
  return {.update = [this](std::string_view stage, std::size_t done,
                           std::size_t total) { update(stage, done, total); },
          .stop_requested = stop_was_requested};
}

void terminal_progress::update(std::string_view stage, std::size_t done, std::size_t total) {
  if (stage != stage_) {
    finish();
    start(stage);
  }
  done_ = done;
  total_ = total;
  const auto interval = in_place_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(10000);
  if (clock::now() - written_ >= interval)
    write(false);
}

void terminal_progress::start(std::string_view stage) {
  stage_ = stage;
  done_ = total_ = 0;
  started_ = written_ = clock::now();
  width_ = 0;
  if (in_place_)
    write(false);
}

void terminal_progress::finish() {
  if (!stage_.empty())
    write(true);
  stage_.clear();
}

void terminal_progress::write(bool last) {
  written_ = clock::now();
  const double seconds = std::chrono::duration<double>(written_ - started_).count();
  std::string line = formatted("%-22s", stage_.c_str());
  if (total_ > 1)
    line += formatted(
        " %12s",
        (count_text(static_cast<double>(done_)) + "/" + count_text(static_cast<double>(total_))).c_str());
  else
    line += formatted(" %12s", "");
  line += formatted("  %10s", duration_text(seconds).c_str());
  const double rate = seconds > 0 ? static_cast<double>(done_) / seconds : 0;
  if (total_ > 1 && rate > 0)
    line += formatted("  %9s/s", count_text(rate).c_str());
  if (!last && rate > 0 && total_ > done_)
    line += "  " + duration_text(static_cast<double>(total_ - done_) / rate) + " left";

  const std::size_t width = line.size();
  if (in_place_) {
    line.append(width_ > width ? width_ - width : 0, ' ');
    line.insert(line.begin(), '\r');
    width_ = width;
  }
  if (last || !in_place_)
    line += '\n';
  std::fwrite(line.data(), 1, line.size(), stream_);
  std::fflush(stream_);
}

std::string duration_text(double seconds) {
  if (seconds < 1)
    return formatted("%.2f s", seconds);
  if (seconds < 99.95)
    return formatted("%.1f s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600)
    return formatted("%ld min %02ld s", whole / 60, whole % 60);
  return formatted("%ld h %02ld min", whole / 3600, whole % 3600 / 60);
}

std::string count_text(double count) {
  if (count < 1000)
    return formatted("%.*f", count == std::floor(count) || count >= 100 ? 0 : count >= 10 ? 1 : 2, count);
  const char* unit = "k";
  count /= 1e3;
  if (count >= 999.5) {
    unit = "M";
    count /= 1e3;
  }
  if (count >= 999.5) {
    unit = "G";
    count /= 1e3;
  }
  return formatted("%.*f %s", count >= 99.95 ? 0 : count >= 9.995 ? 1 : 2, count, unit);
}

} // namespace dovetail::app
