#include "dovetail/files/sizing_json.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>
#include <fstream>
#include <string>

using namespace dovetail;
using sizing::parse_sizing;
using testing::has;

namespace {

/// The message of the typed error that a text must provoke.
template <class Error = sizing_error>
std::string message_of(const std::string& text, const sizing::json_options& options = {}) {
  return testing::refusal_of<Error>([&] { return parse_sizing(text, "sizes.json", options); });
}

const char* const everything = R"({
  "size": 2.0,
  "sources": [
    {"type": "point", "at": [1, 0, 0], "inner_radius": 0.5, "outer_radius": 1, "spacing": 0.1},
    {"type": "line", "name": "edge", "from": [0, 5, 0], "to": [4, 5, 0],
     "inner_radius": 0.1, "outer_radius": [0.5, 0.7], "spacing": [0.05, 0.1]},
    {"type": "triangle", "corners": [[0, 9, 0], [1, 9, 0], [0, 9, 1]],
     "inner_radius": 0, "outer_radius": 1, "spacing": 0.2, "growth": "doubling"}
  ],
  "minimum": [ {"size": 1.5}, {"size": 3, "scale": 2} ],
  "scale": 2,
  "smallest": 0.15,
  "largest": 2.5
})";

} // namespace

TEST_CASE("all members of the format make the field they describe") {
  const auto h = parse_sizing(everything, "sizes.json");
  CHECK(h({1, 0, 0}) == doctest::Approx(0.2));
  CHECK(h({0, 5, 0}) == doctest::Approx(0.15));
  CHECK(h({4, 5, 0}) == doctest::Approx(0.2));
  CHECK(h({0, 9, 0.5}) == doctest::Approx(0.4));
  CHECK(h({50, 50, 50}) == 2.5);
  CHECK(h.smallest_size_in({{40, 40, 40}, {50, 50, 50}}) == 2.5);
  CHECK(parse_sizing(R"({"size": 0.5})", "a")({}) == 0.5);
}

TEST_CASE("a gradation is exact for sources and precomputed for the rest") {
  const std::string source = R"("sources": [{"type": "point", "at": [0, 0, 0], "inner_radius": 1,
    "outer_radius": 1.01, "spacing": 0.1}])";
  const auto exact = parse_sizing("{\"size\": 2, " + source + ", \"gradation\": 0.5}", "a");
  CHECK(exact({2, 0, 0}) == doctest::Approx(0.6).epsilon(0.01));
  const auto by_default = parse_sizing("{\"size\": 2, " + source + ", \"gradation\": true}", "a");
  CHECK(by_default({2, 0, 0}) == doctest::Approx(0.35).epsilon(0.01));
  const std::string nested =
      "{\"minimum\": [{\"size\": 2, " + source + "}], \"gradation\": {\"slope\": 0.5}}";
  const auto octree = parse_sizing(nested, "a", {.domain = {{-4, -4, -4}, {4, 4, 4}}});
  CHECK(octree({2, 0, 0}) == doctest::Approx(0.6).epsilon(0.15));
  CHECK(has(message_of(nested), "sizes.json:2: the domain of the gradation"));
}

TEST_CASE("errors name file, line and key") {
  CHECK(has(message_of("{\n\n  \"size\": 1,\n  \"sise\": 2\n}"), "sizes.json:4: unknown key \"sise\""));
  CHECK(has(message_of("{\n  \"size\": 0\n}"), "sizes.json:2: \"size\" is 0;"));
  CHECK(has(message_of("{\n  \"size\":\n\n -3}"), "sizes.json:2: \"size\" is -3;"));
  CHECK(has(message_of("{\n  \"size\": \"1\"\n}"), "sizes.json:2: \"size\" must be a finite number"));
  CHECK(has(message_of("{\n \"size\": 1,\n \"size\": 2 }"), "sizes.json:3: key \"size\" is given twice"));
  CHECK(has(message_of("\n{}"), "sizes.json:2: a sizing field needs"));
  CHECK(has(message_of("[1]"), "sizes.json:1: a sizing field must be an object"));
  CHECK(has(message_of("{\"minimum\": []}"), "\"minimum\" is empty"));
  CHECK(has(message_of("{\"sources\": []}"), "\"sources\" need \"size\""));
  CHECK(has(message_of("{\"size\": 1, \"smallest\": 3, \"largest\": 2}"),
            "sizes.json:1: the lower size bound"));
  CHECK(has(message_of("{\"size\": 1, \"gradation\": -1}"), "\"gradation\" is -1"));
  CHECK(has(message_of("{\n\"background\": {\"file\": \"x.vtu\"}}"), "sizes.json:2: a background mesh"));
}

TEST_CASE("errors in a source name its line and key") {
  const auto with = [](const std::string& source) {
    return message_of("{\n  \"size\": 1,\n  \"sources\": [\n" + source + "\n]}");
  };
  const std::string start = R"({"type": "point", "at": [0, 0, 0],)";
  CHECK(has(with(start + "\n\"inner_radius\": 1, \"outer_radius\": 2}"), "the key \"spacing\" is missing"));
  CHECK(has(with(start + "\n\"inner_radius\": 1,\n \"outer_radius\": 2, \"spacing\": -1}"),
            "\"spacing\" is -1"));
  CHECK(has(with(start + "\"inner_radius\": 3, \"outer_radius\": 2, \"spacing\": 1}"), "smaller than"));
  CHECK(has(with(R"({"type": "ball"})"), "unknown source type \"ball\""));
  CHECK(has(with(R"({"type": "point", "at": [0, 0]})"), "\"at\" must be a point"));
  CHECK(has(with(R"({"type": "line", "at": [0, 0, 0]})"), "unknown key \"at\" in a line source"));
  const std::string third_line = "{\"size\": 1,\n\"sources\": [\n" + start +
                                 "\n\"inner_radius\": 1,\n\"outer_radius\": 2,\n\"spacing\": 0}]}";
  CHECK(has(message_of(third_line), "sizes.json:6: \"spacing\" is 0"));
}

TEST_CASE("what is no JSON is an input error with its line") {
  CHECK(has(message_of<input_error>("{\n  \"size\": 1\n  \"scale\": 2}"), "sizes.json:3: not valid JSON"));
  CHECK(has(message_of<input_error>(""), "sizes.json:1: not valid JSON"));
  CHECK(has(message_of<input_error>("{\"size\": nan}"), "not valid JSON"));
  CHECK(has(message_of<input_error>("{\"size\": 1e999}"), "not valid JSON"));
  CHECK_THROWS_AS(sizing::read_sizing("no/such/file.json"), input_error);
  CHECK_THROWS_AS(sizing::read_sizing(std::filesystem::temp_directory_path()), input_error);
}

TEST_CASE("values nested too deep are refused, whatever they are") {
  const std::size_t millions = 2'000'000;
  std::string objects;
  for (std::size_t depth = 0; depth < millions; ++depth)
    objects += "{\"a\":";
  for (const std::string& text :
       {std::string(millions, '['), objects, "{\n\"a\":" + std::string(65, '[') + std::string(65, ']') + "}"})
    CHECK_THROWS_WITH_AS(sizing::parse_json(text, "deep.json"), doctest::Contains("nested more than 64 deep"),
                         input_error);
  CHECK(sizing::parse_json(std::string(64, '[') + std::string(64, ']'), "deep.json").items.size() == 1);
}

TEST_CASE("a background mesh comes through the caller's reader, relative to the file") {
  const auto folder = std::filesystem::temp_directory_path() / "dovetail_test_json";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "sizes.json")
      << R"({"background": {"file": "mesh.vtu", "array": "h"}, "scale": 10})";
  std::filesystem::path asked;
  sizing::json_options options;
  options.load_background = [&](const std::filesystem::path& file, const std::string& array) {
    asked = file;
    CHECK(array == "h");
    return background_field({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}}, {1, 2, 3, 4});
  };
  const auto h = sizing::read_sizing(folder / "sizes.json", options);
  CHECK(asked == folder / "mesh.vtu");
  CHECK(h({0, 1, 0}) == doctest::Approx(30));
  std::filesystem::remove_all(folder);
}

TEST_CASE("sizes from the model are asked for with the options given") {
  std::vector<automatic_options> asked;
  const sizing::json_options options{.size_from_model = [&](const automatic_options& o) {
    asked.push_back(o);
    return point_sizes({{{0, 0, 0}, 0.1}}, 0.5, 1.0);
  }};
  const auto h = parse_sizing(R"({"size": 0.8, "curvature": 30, "proximity": {"elements_across": 1.5,
    "where": "both", "smallest": 0.01, "growth": 0.4}})",
                              "a", options);
  CHECK(h({0, 0, 0}) == doctest::Approx(0.1));
  CHECK(h({9, 0, 0}) == 0.8);
  REQUIRE(asked.size() == 2);
  CHECK(asked[0].elements_per_circle == 30);
  CHECK(asked[0].elements_across == 0);
  CHECK(asked[0].range.largest == 0.8);
  CHECK(asked[1].elements_per_circle == 0);
  CHECK(asked[1].elements_across == 1.5);
  CHECK((asked[1].inside && asked[1].outside));
  CHECK(asked[1].range.smallest == 0.01);
  CHECK(asked[1].range.growth == 0.4);
  (void)parse_sizing(R"({"automatic": true})", "a", options);
  REQUIRE(asked.size() == 3);
  CHECK(asked[2].elements_per_circle == automatic_options{}.elements_per_circle);
  CHECK(asked[2].range.largest == 0);
}

TEST_CASE("faults of sizes from the model name line and key") {
  CHECK(has(message_of("{\"size\": 1,\n\"curvature\": 20}"), "sizes.json:2: \"curvature\" needs a model"));
  CHECK(has(message_of(R"({"proximity": -2})"), "\"proximity\" is -2"));
  CHECK(has(message_of(R"({"automatic": {"where": "beside"}})"), "unknown place \"beside\""));
  CHECK(has(message_of(R"({"automatic": {"elements": 2}})"), "unknown key \"elements\""));
}
