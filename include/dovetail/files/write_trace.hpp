/// @file
/// Execution traces as files in the Trace Event Format, which Perfetto shows (ui.perfetto.dev).
#pragma once

#include "dovetail/core/output_file.hpp"
#include "dovetail/parallel/execution_trace.hpp"

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

namespace dovetail::io {

namespace detail {

/// A text between quotes in JSON. Bytes that are no ASCII stand for themselves as a number: they may not be
/// UTF-8.
inline std::string json_escaped(const std::string& text) {
  constexpr const char* digits = "0123456789abcdef";
  std::string escaped;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f)
      escaped.append("\\u00").append({digits[byte >> 4U], digits[byte & 15U]});
    else
      escaped.append(c == '"' || c == '\\' ? "\\" : "").append(1, c);
  }
  return escaped;
}

/// Writes one event after the other.
class trace_events {
public:
  static constexpr int stages = 0, batches = 1, first_worker = 2; ///< the format's threads
  static constexpr double unit = 1e-6;                            ///< of the format's times, seconds

  explicit trace_events(output_file& file) : file_(file) {}

  void name_thread(int thread, const std::string& name) {
    begin("M", thread, "thread_name");
    file_.text(R"(, "args": {"name": ")" + json_escaped(name) + "\"}}");
  }
  void span(int thread, const std::string& name, double begin_seconds, double seconds) {
    begin("X", thread, name);
    file_.text(R"(, "ts": )");
    file_.number(begin_seconds / unit);
    file_.text(R"(, "dur": )");
    file_.number(seconds / unit);
    file_.text(R"(, "args": {)");
    first_argument_ = true;
  }
  void argument(const char* name, std::size_t value) {
    file_.text(std::string(first_argument_ ? "\"" : ", \"") + name + "\": ");
    file_.number(value);
    first_argument_ = false;
  }
  void end_span() { file_.text("}}"); }

private:
  void begin(const char* kind, int thread, const std::string& name) {
    file_.text(std::string(any_ ? ",\n" : "\n") + R"({"ph": ")" + kind + R"(", "pid": 0, "tid": )" +
               std::to_string(thread) + R"(, "name": ")" + json_escaped(name) + "\"");
    any_ = true;
  }

  output_file& file_;
  bool any_ = false;
  bool first_argument_ = true;
};

} // namespace detail

/// Writes a trace: the stages on one line, batches on the next, then a line per worker. Throws `io_error`.
/// Linear in the trace.
/// \param trace what `parallel::traced` recorded
/// \param path the file, which is replaced
inline void write_trace(const execution_trace& trace, const std::filesystem::path& path) {
  using detail::trace_events;
  output_file file(path);
  file.text("{\"otherData\": {\"workers\": ");
  file.number(trace.workers);
  file.text(", \"elements\": ");
  file.number(trace.elements);
  file.text(", \"seconds\": ");
  file.number(trace.seconds);
  if (!trace.subject.empty())
    file.text(", \"subject\": \"" + detail::json_escaped(trace.subject) + "\"");
  if (trace.sizes.are_known()) {
    file.text(", \"background_elements\": ");
    file.number(trace.sizes.background_elements);
    file.text(", \"skeleton_sides\": ");
    file.number(trace.sizes.skeleton_sides);
    file.text(", \"largest_piece\": ");
    file.number(trace.sizes.largest_piece);
  }
  file.text("},\n\"displayTimeUnit\": \"ms\",\n\"traceEvents\": [");
  trace_events events(file);
  events.name_thread(trace_events::stages, "stages");
  events.name_thread(trace_events::batches, "tasks given at once");
  std::set<int> workers;
  for (const batch_span& batch : trace.batches)
    for (const task_span& task : batch.tasks)
      if (workers.insert(task.worker).second)
        events.name_thread(trace_events::first_worker + task.worker, "worker " + std::to_string(task.worker));
  for (const stage_span& stage : trace.stages) {
    events.span(trace_events::stages, stage.stage, stage.begin, stage.end - stage.begin);
    events.end_span();
  }
  for (const batch_span& batch : trace.batches) {
    events.span(trace_events::batches, batch.stage, batch.begin, batch.end - batch.begin);
    events.argument("failed", batch.failed);
    events.argument("once", batch.once ? 1 : 0);
    events.end_span();
    for (const task_span& task : batch.tasks) {
      events.span(trace_events::first_worker + task.worker, batch.stage, batch.begin + task.begin,
                  task.seconds);
      events.argument("task", task.task);
      events.argument("bytes", task.result_bytes);
      events.end_span();
    }
  }
  file.text("\n]}\n");
  file.commit();
}

} // namespace dovetail::io
