#include "dovetail/files/read_trace.hpp"
#include "dovetail/files/write_trace.hpp"
#include "files/scratch_folder.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

using namespace dovetail;

namespace {

execution_trace small_trace() {
  execution_trace trace{.workers = 2, .elements = 1234567, .seconds = 9.5};
  trace.stages = {{"planning", 0, 1.25}, {"meshing", 1.25, 9.5}};
  trace.batches = {{"meshing", 1.5, 9, {{0, 1, 0.25, 3.5, 1000}, {1, 0, 0.125, 7, 0}}, 1},
                   {"finishing", 9, 9.25, {{0, 0, 0, 0.125, 16}}, 0, true}};
  trace.sizes = {5000, 70000, 12345.5};
  trace.subject = "wing \"a\".step, --dimension 2";
  return trace;
}

} // namespace

TEST_CASE("A trace is read back as it was written, and its events are those of the format") {
  const testing::scratch_folder scratch("trace");
  const auto file = scratch / "trace.json";
  io::write_trace(small_trace(), file);
  CHECK(io::read_trace(file) == small_trace());

  execution_trace without_sizes = small_trace();
  without_sizes.sizes = {};
  without_sizes.subject = {};
  io::write_trace(without_sizes, scratch / "older.json");
  CHECK(io::read_trace(scratch / "older.json") == without_sizes);

  std::ifstream text(file);
  const std::string all{std::istreambuf_iterator<char>(text), std::istreambuf_iterator<char>()};
  const auto events = sizing::parse_json(all, "trace");
  REQUIRE(events.find("traceEvents") != nullptr);
  std::size_t spans = 0;
  for (const auto& event : events.find("traceEvents")->items)
    if (event.find("ph")->text == "X") {
      ++spans;
      for (const char* key : {"name", "ts", "dur", "pid", "tid", "args"})
        CHECK(event.find(key) != nullptr);
    }
  CHECK(spans == 7);
}

TEST_CASE("What is no trace is refused by file and line") {
  const testing::scratch_folder scratch("trace");
  const auto file = scratch / "trace.json";
  const auto refused = [&](const std::string& text, const char* why) {
    std::ofstream(file) << text;
    CHECK_THROWS_WITH_AS(io::read_trace(file), doctest::Contains(why), input_error);
    CHECK_THROWS_WITH_AS(io::read_trace(file), doctest::Contains("trace.json:"), input_error);
  };
  refused("{", "not valid JSON");
  refused("[]", "there is no \"otherData\"");
  refused("{\n\"otherData\": {\"workers\": 0}}", "trace.json:2: \"workers\" is no number in its range");
  refused(R"({"otherData": {"workers": 1, "elements": 1, "seconds": 1, "largest_piece": 5}})",
          "there is no \"background_elements\"");
  const std::string about = R"({"otherData": {"workers": 1, "elements": 1, "seconds": 1},)";
  refused(about + R"("other": 1})", "there is no \"traceEvents\"");
  refused(about + R"("traceEvents": [{"ph": "X", "tid": 0, "ts": -1}]})", "\"ts\" is no number");
  refused(about + R"("traceEvents": [{"ph": "X", "name": "a", "tid": 2, "ts": 0, "dur": 1, "args": {}}]})",
          "a task is before its batch");
  CHECK_THROWS_WITH_AS(io::read_trace(scratch / "none.json"), doctest::Contains("cannot be opened"),
                       input_error);
}
