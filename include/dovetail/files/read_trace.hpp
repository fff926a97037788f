/// @file
/// Reads the execution traces that `write_trace` wrote.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/files/json_tree.hpp"
#include "dovetail/files/write_trace.hpp"
#include "dovetail/parallel/execution_trace.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace dovetail::io {

namespace detail {

/// Turns the events back into a trace; every message names the file and the line.
class trace_reader {
public:
  explicit trace_reader(std::string file) : file_(std::move(file)) {}

  execution_trace read(const sizing::json_value& root) {
    const auto& about = member(root, "otherData");
    trace_.workers = static_cast<int>(number(about, "workers", 1, 1e9));
    trace_.elements = number(about, "elements", 0, 1e18);
    trace_.seconds = number(about, "seconds", 0, 1e9);
    if (about.find("largest_piece") != nullptr) // older traces have none of these
      trace_.sizes = {number(about, "background_elements", 0, 1e18), number(about, "skeleton_sides", 0, 1e18),
                      number(about, "largest_piece", 1, 1e18)};
    if (about.find("subject") != nullptr)
      trace_.subject = text(about, "subject");
    for (const auto& event : member(root, "traceEvents").items)
      if (text(event, "ph") == "X")
        add(event);
    return std::move(trace_);
  }

private:
  [[noreturn]] void fail(const sizing::json_value& at, const std::string& what) const {
    throw input_error(file_ + ":" + std::to_string(at.line) + ": " + what +
                      "; this is no trace written by --trace");
  }
  const sizing::json_value& member(const sizing::json_value& of, const char* name) const {
    const auto* found = of.find(name);
    if (found == nullptr)
      fail(of, "there is no \"" + std::string(name) + "\"");
    return *found;
  }
  double number(const sizing::json_value& of, const char* name, double least, double most) const {
    const auto& found = member(of, name);
    if (found.type != sizing::json_value::kind::number || !(found.number >= least && found.number <= most))
      fail(found, "\"" + std::string(name) + "\" is no number in its range");
    return found.number;
  }
  const std::string& text(const sizing::json_value& of, const char* name) const {
    return member(of, name).text;
  }

  void add(const sizing::json_value& event) {
    constexpr double longest = 1e9 / trace_events::unit;
    const int thread = static_cast<int>(number(event, "tid", 0, 1e9));
    const double begin = number(event, "ts", 0, longest) * trace_events::unit;
    const double seconds = number(event, "dur", 0, longest) * trace_events::unit;
    const auto& arguments = member(event, "args");
    if (thread == trace_events::stages) {
      trace_.stages.push_back({text(event, "name"), begin, begin + seconds});
    } else if (thread == trace_events::batches) {
      trace_.batches.push_back({text(event, "name"), begin, begin + seconds});
      trace_.batches.back().failed = static_cast<std::size_t>(number(arguments, "failed", 0, 1e15));
      trace_.batches.back().once = number(arguments, "once", 0, 1) != 0;
    } else if (trace_.batches.empty()) {
      fail(event, "a task is before its batch");
    } else {
      batch_span& batch = trace_.batches.back();
      batch.tasks.push_back({static_cast<std::size_t>(number(arguments, "task", 0, 1e15)),
                             thread - trace_events::first_worker, begin - batch.begin, seconds,
                             static_cast<std::size_t>(number(arguments, "bytes", 0, 1e18))});
    }
  }

  std::string file_;
  execution_trace trace_;
};

} // namespace detail

/// Reads what `write_trace` wrote, times to a nanosecond. Throws `input_error` that names the line.
/// Linear in the file.
/// \param path a file that `write_trace` wrote
inline execution_trace read_trace(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw input_error(path.string() + ": cannot be opened");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return detail::trace_reader(path.string()).read(sizing::parse_json(text, path.string()));
}

} // namespace dovetail::io
