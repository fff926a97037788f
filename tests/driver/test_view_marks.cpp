#include "view_marks.hpp"

#include "dovetail/core/error.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <string>

namespace dovetail::app {
namespace {

using dovetail::testing::scratch_folder;
using dovetail::testing::write_content;

view_marks read(const std::string& text) {
  const scratch_folder folder("view_marks");
  write_content(folder / "run.json", text);
  return marks_of_report(folder / "run.json");
}

/// What is said of a report that cannot be read.
std::string refusal_of(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const input_error& problem) {
    return problem.what();
  }
  return "accepted";
}

/// A report with these angles below the threshold.
std::string with_angles(const std::string& list) {
  return R"({"interfaces": {"below_threshold": )" + list + "}}";
}

const std::string whole_report = R"({
  "model": "wing",
  "suppressed": [{"what": "narrow face", "entity": 31, "length": 0.25, "at": [1, 1, 2]}],
  "poor_elements": {"causes": [{"cause": "thin wall", "bad": 3, "low": 9}], "thinnest_wall": {"thickness": 0.0125, "at": [7, 8, 9]}},
  "interfaces": {
    "min_face_angle_deg": null,
    "below_threshold": [
      {"angle_deg": 7.25, "of": "dihedral", "cause": "forced", "at": [1, 2.5, -3e-1], "cad": ["face 1", "edge 4"]},
      {"angle_deg": 12, "of": "face", "cause": "remeshing", "at": [0, 0, 0], "cad": []},
      {"angle_deg": 13, "of": "face", "cause": "forced", "at": [0, 0, 1], "cad": []}],
    "coarse": {"below_threshold": [
      {"angle_deg": 9, "of": "face", "cause": "refused", "at": [4, 5, 6], "cad": ["face 2"]},
      {"angle_deg": 9, "of": "face", "cause": "unheard of", "at": [4, 5, 6], "cad": []}]}}})";

TEST_CASE("all places of a report become marks, the thinnest wall first") {
  const view_marks marks = read(whole_report);
  REQUIRE(marks.all.size() == 7);
  CHECK(marks.report.ends_with("run.json"));
  CHECK(marks.all[0].label == "thinnest wall");
  CHECK(marks.all[0].text == "thinnest wall, thickness 0.0125");
  CHECK(marks.all[0].place == vec3{7, 8, 9});
  CHECK(marks.all[1].label == "interface angle, forced");
  CHECK(marks.all[1].text == "interface angle, forced: 7.25° of a dihedral; CAD: face 1, edge 4");
  CHECK(marks.all[1].place == vec3{1, 2.5, -0.3});
  CHECK(marks.all[2].text == "interface angle, remeshing: 12° of a face");
  CHECK(marks.all[4].label == "coarse interface angle, refused");
  CHECK(marks.all[4].text == "coarse interface angle, refused: 9° of a face; CAD: face 2");
  CHECK(marks.all[6].label == "detail left out");
  CHECK(marks.all[6].text == "narrow face 31, left out; 0.25");
  CHECK(marks.all[6].place == vec3{1, 1, 2});
}

TEST_CASE("marks of one label have one colour, and other labels another one") {
  const view_marks marks = read(whole_report);
  CHECK(marks.all[1].colour == marks.all[3].colour);
  const auto labels = labels_of(marks);
  REQUIRE(labels.size() == 6);
  for (std::size_t a = 0; a < labels.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      CHECK(labels[a].colour != labels[b].colour);
  CHECK(text_of(marks) ==
        "7 marks: 1 x thinnest wall (violet); 2 x interface angle, forced (red); "
        "1 x interface angle, remeshing (blue); 1 x coarse interface angle, refused (pale orange); "
        "1 x coarse interface angle, unheard of (pale grey); 1 x detail left out (green)");
}

TEST_CASE("the number of elements is read where there is one") {
  CHECK(read(whole_report).elements == 0);
  CHECK(read(R"({"elements": 12})").elements == 12);
  CHECK(read(R"({"elements": "many"})").elements == 0);
}

TEST_CASE("a report that lists no places has no marks") {
  for (const char* text :
       {"{}", R"({"quality": {"worst_element": 7}, "elements": 12})", R"({"interfaces": {}})",
        R"({"poor_elements": {"causes": [], "thinnest_wall": null}})",
        R"({"interfaces": {"below_threshold": [], "coarse": {"below_threshold": []}}})"}) {
    CHECK_MESSAGE(read(text).all.empty(), text);
    CHECK(text_of(read(text)).starts_with("no marks"));
  }
}

TEST_CASE("what is no report is refused, by the file's name and what is wrong") {
  const std::pair<std::string, std::string> refused[] = {
      {"no report", "it is not valid JSON"},
      {whole_report.substr(0, whole_report.size() / 2), "it is not valid JSON"},
      {"{\"model\": \"\xff\"}", "it is not valid JSON"},
      {std::string(200000, '['), "it is not valid JSON"},
      {"[]", "it is no JSON object"},
      {"null", "it is no JSON object"},
      {"7", "it is no JSON object"},
      {R"({"interfaces": 3})", "interfaces is no object"},
      {R"({"interfaces": null})", "interfaces is no object"},
      {R"({"interfaces": {"coarse": []}})", "interfaces/coarse is no object"},
      {R"({"interfaces": {"coarse": {"below_threshold": {}}}})",
       "interfaces/coarse/below_threshold is no list"},
      {R"({"suppressed": {}})", "suppressed is no list"},
      {R"({"suppressed": [7]})", "suppressed/0 is no object"},
      {R"({"suppressed": [{"what": 1, "entity": 1, "length": 1, "at": [1, 2, 3]}]})", "what is no text"},
      {R"({"suppressed": [{"what": "", "length": 1, "at": [1, 2, 3]}]})", "suppressed/0 has no \"entity\""},
      {R"({"poor_elements": "many"})", "poor_elements is no object"},
      {R"({"poor_elements": {"thinnest_wall": 0.1}})", "poor_elements/thinnest_wall is no object"},
      {R"({"poor_elements": {"thinnest_wall": {"at": [1, 2, 3]}}})", "thinnest_wall has no \"thickness\""},
      {R"({"poor_elements": {"thinnest_wall": {"thickness": null, "at": [1, 2, 3]}}})",
       "thickness is no finite number"},
      {R"({"poor_elements": {"thinnest_wall": {"thickness": 1}}})", "thinnest_wall has no \"at\""}};
  for (const auto& [text, why] : refused) {
    const std::string said = refusal_of(text);
    CHECK_MESSAGE(said.find("run.json: ") != std::string::npos, said);
    CHECK_MESSAGE(said.find(why) != std::string::npos, said);
    CHECK_MESSAGE(said.ends_with("; give the JSON file that 'dovetail mesh --report' has written"), said);
  }
}

TEST_CASE("an angle that is not as reports have it is refused by its number") {
  const std::string good =
      R"({"angle_deg": 1, "of": "face", "cause": "forced", "at": [1, 2, 3], "cad": ["face 1"]})";
  REQUIRE(read(with_angles("[" + good + "]")).all.size() == 1);
  const auto with = [&](const std::string& old, const std::string& other) {
    std::string changed = good;
    REQUIRE(changed.find(old) != std::string::npos);
    return with_angles("[" + good + ", " + changed.replace(changed.find(old), old.size(), other) + "]");
  };
  const std::pair<std::string, std::string> refused[] = {
      {with_angles("{}"), "below_threshold is no list"},
      {with_angles("[" + good + ", 7]"), "below_threshold/1 is no object"},
      {with_angles("[" + good + ", [1, 2]]"), "below_threshold/1 is no object"},
      {with("\"angle_deg\": 1, ", ""), "/1 has no \"angle_deg\""},
      {with("\"of\": \"face\", ", ""), "/1 has no \"of\""},
      {with("\"cause\": \"forced\", ", ""), "/1 has no \"cause\""},
      {with("\"at\": [1, 2, 3], ", ""), "/1 has no \"at\""},
      {with(", \"cad\": [\"face 1\"]", ""), "/1 has no \"cad\""},
      {with("deg\": 1", "deg\": \"1\""), "/1/angle_deg is no finite number"},
      {with("deg\": 1", "deg\": null"), "/1/angle_deg is no finite number"},
      {with("deg\": 1", "deg\": NaN"), "it is not valid JSON"},
      {with("[1, 2, 3]", "[1, 2, 1e999]"), "it is not valid JSON"},
      {with("[1, 2, 3]", "[1, 2, null]"), "/1/at/2 is no finite number"},
      {with("[1, 2, 3]", "[1, [2], 3]"), "/1/at/1 is no finite number"},
      {with("[1, 2, 3]", "[true, 2, 3]"), "/1/at/0 is no finite number"},
      {with("[1, 2, 3]", "[1, 2]"), "/1/at is no list of three numbers"},
      {with("[1, 2, 3]", "[1, 2, 3, 4]"), "/1/at is no list of three numbers"},
      {with("[1, 2, 3]", "{\"x\": 1}"), "/1/at is no list of three numbers"},
      {with("\"face\"", "3"), "/1/of is no text"},
      {with("\"forced\"", "[]"), "/1/cause is no text"},
      {with("[\"face 1\"]", "\"face 1\""), "/1/cad is no list"},
      {with("\"face 1\"", "\"face 1\", 2"), "/1/cad/1 is no text"}};
  for (const auto& [text, why] : refused) {
    const std::string said = refusal_of(text);
    CHECK_MESSAGE(said.find(why) != std::string::npos, said);
  }
}

TEST_CASE("a file that is not there, is empty or a folder, is refused") {
  const scratch_folder folder("view_marks");
  CHECK_THROWS_AS(static_cast<void>(marks_of_report(folder / "missing.json")), input_error);
  CHECK_THROWS_AS(static_cast<void>(marks_of_report(folder / "")), input_error);
  CHECK(refusal_of("").ends_with(
      "run.json: the file is empty; give the JSON file that 'dovetail mesh --report' has written"));
}

TEST_CASE("marks far from the mesh are counted") {
  view_marks marks = read(whole_report);
  CHECK(marks_outside(marks, {{-1, -1, -1}, {9, 9, 9}}) == 0);
  CHECK(marks_outside(marks, {{0, 0, 0}, {5, 5, 6}}) == 2); // the wall, and the first angle by its z
}

} // namespace
} // namespace dovetail::app
