/// @file
/// What the files of an OpenFOAM mesh say, as text.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// Words, numbers and lists of a file, past its header. Throws `input_error` naming file and line.
class foam_text {
public:
  /// \param kind the class that the header must give
  foam_text(const std::filesystem::path& file, std::string_view kind)
      : content_(read_file(file)), at_(content_, file.string()) {
    if (word() != "FoamFile")
      fail("it does not begin with the header FoamFile");
    expect('{');
    bool is_text = false;
    std::string kind_here;
    while (!take('}')) {
      const std::string key(word());
      const std::string value = entry();
      is_text = is_text || (key == "format" && value == "ascii");
      if (key == "class")
        kind_here = value;
      else if (key == "note")
        note_ = value;
    }
    if (!is_text)
      fail("it is not of format ascii; write it with writeFormat ascii, as dovetail does");
    if (kind_here != kind)
      fail("it has a " + kind_here + ", not a " + std::string(kind) + " as dovetail writes");
  }

  foam_text(const foam_text&) = delete; // the cursor looks into the content
  foam_text& operator=(const foam_text&) = delete;

  const std::string& note() const { return note_; }
  const std::string& name() const { return at_.name(); }

  /// Passes a character if it is the next one.
  bool take(char c) {
    skip();
    const bool here = !at_.at_end() && at_.rest().front() == c;
    if (here)
      at_.skip(1);
    return here;
  }
  void expect(char c) {
    if (!take(c))
      fail(at_.at_end() ? std::string("the file ends early") : std::string("'") + c + "' is expected");
  }
  std::string_view word() {
    skip();
    const auto found = at_.rest().substr(0, at_.rest().find_first_of(" \t\r\n(){};"));
    at_.skip(found.size());
    if (found.empty())
      fail(at_.at_end() ? "the file ends early" : "a word is expected");
    return found;
  }
  /// What stands before the next semicolon, without quotes.
  std::string entry() {
    skip();
    const auto end = at_.rest().find(';');
    if (end == std::string_view::npos)
      fail("the file ends early: ';' is expected");
    std::string text(at_.rest().substr(0, end));
    at_.skip(end + 1);
    if (text.size() > 1 && text.front() == '"' && text.back() == '"')
      text = text.substr(1, text.size() - 2);
    return text;
  }
  template <class Number>
  Number number() {
    skip();
    const auto text = at_.rest();
    Number value{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem == std::errc::result_out_of_range)
      fail("a number is out of range");
    const auto size = static_cast<std::size_t>(end - text.data());
    if (problem != std::errc() ||
        (size < text.size() && std::string_view(" \t\r\n();}").find(text[size]) == std::string_view::npos))
      fail(at_.at_end() ? "the file ends early: a number is expected" : "a number is expected");
    at_.skip(size);
    return value;
  }
  /// Calls `read(i)` for each entry of a list, of so many bytes at least.
  template <class Read>
  std::size_t list(std::size_t bytes_each, const Read& read) {
    const auto announced = number<std::int64_t>();
    if (announced < 0 || announced > std::numeric_limits<local_id>::max())
      fail("a list of " + std::to_string(announced) + " entries is none");
    const auto count = at_.plausible(static_cast<std::uint64_t>(announced), bytes_each);
    expect('(');
    for (std::size_t i = 0; i < count; ++i)
      read(i);
    if (!take(')'))
      fail("the list does not end after the " + std::to_string(count) + " entries that it announces");
    return count;
  }
  std::vector<local_id> labels() {
    std::vector<local_id> values;
    list(2, [&](std::size_t) {
      values.push_back(number<local_id>());
      if (values.back() < 0)
        fail("the number " + std::to_string(values.back()) + " is negative");
    });
    return values;
  }
  /// Refuses what stands behind the last thing that is read.
  void expect_end() {
    skip();
    if (!at_.at_end())
      fail("there is more than one list in the file");
  }
  [[noreturn]] void fail(const std::string& what) const { at_.fail(what); }

private:
  /// Passes space and comments.
  void skip() {
    for (;;) {
      at_.skip_space();
      const auto rest = at_.rest();
      if (rest.starts_with("//"))
        at_.skip(rest.find('\n')); // npos: to the end
      else if (rest.starts_with("/*"))
        at_.skip(std::min(rest.find("*/"), rest.size() - 2) + 2);
      else
        return;
    }
  }

  std::string content_;
  file_cursor at_;
  std::string note_;
};

/// One patch of the boundary.
struct foam_patch {
  std::string name{};
  std::string type{};
  std::int64_t faces = -1;
  std::int64_t first = -1;
  std::int64_t here = -1;  ///< of a processor patch: this processor
  std::int64_t there = -1; ///< the other one

  bool is_of_processor() const { return type == "processor"; }
};

inline std::vector<vec3> read_foam_points(const std::filesystem::path& file) {
  foam_text text(file, "vectorField");
  std::vector<vec3> points;
  text.list(8, [&](std::size_t i) {
    text.expect('(');
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = text.number<double>();
      if (!std::isfinite(p[axis]))
        text.fail("a coordinate of point " + std::to_string(i) + " is not finite");
    }
    text.expect(')');
    points.push_back(p);
  });
  text.expect_end();
  return points;
}

inline std::vector<simplex<2>> read_foam_faces(const std::filesystem::path& file, std::size_t points) {
  foam_text text(file, "faceList");
  std::vector<simplex<2>> faces;
  text.list(9, [&](std::size_t i) {
    if (const auto corners = text.number<std::int64_t>(); corners != 3)
      text.fail("face " + std::to_string(i) + " has " + std::to_string(corners) +
                " points; only tetrahedra, with triangles, are read");
    text.expect('(');
    simplex<2> face;
    for (local_id& v : face) {
      v = text.number<local_id>();
      if (v < 0 || static_cast<std::size_t>(v) >= points)
        text.fail("face " + std::to_string(i) + " has the point " + std::to_string(v) + ", and there are " +
                  std::to_string(points));
    }
    text.expect(')');
    faces.push_back(face);
  });
  text.expect_end();
  return faces;
}

inline std::vector<foam_patch> read_foam_boundary(const std::filesystem::path& file) {
  foam_text text(file, "polyBoundaryMesh");
  std::vector<foam_patch> patches;
  text.list(4, [&](std::size_t) {
    foam_patch patch;
    patch.name = text.word();
    text.expect('{');
    while (!text.take('}')) {
      const std::string key(text.word());
      const std::pair<std::string_view, std::int64_t*> numbers[] = {{"nFaces", &patch.faces},
                                                                    {"startFace", &patch.first},
                                                                    {"myProcNo", &patch.here},
                                                                    {"neighbProcNo", &patch.there}};
      const auto found =
          std::find_if(std::begin(numbers), std::end(numbers), [&](const auto& n) { return n.first == key; });
      if (found != std::end(numbers)) {
        *found->second = text.number<std::int64_t>();
        text.expect(';');
      } else if (const std::string value = text.entry(); key == "type") {
        patch.type = value;
      }
    }
    for (const foam_patch& other : patches)
      if (other.name == patch.name)
        text.fail("there are two patches " + patch.name);
    if (patch.type.empty() || patch.faces < 0 || patch.first < 0)
      text.fail("patch " + patch.name + " lacks a type, nFaces or startFace");
    if (patch.is_of_processor() && (patch.here < 0 || patch.there < 0 || patch.here == patch.there))
      text.fail("patch " + patch.name + " does not say which two processors it lies between");
    patches.push_back(std::move(patch));
  });
  text.expect_end();
  return patches;
}

/// The zone of each cell, and the names of the zones; 0 and none where there are no zones.
inline std::vector<std::string> read_foam_zones(const std::filesystem::path& file,
                                                std::vector<local_id>& of_cell) {
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) {
    std::fill(of_cell.begin(), of_cell.end(), 0);
    return {};
  }
  foam_text text(file, "regIOobject");
  std::vector<std::string> names;
  std::fill(of_cell.begin(), of_cell.end(), no_id);
  text.list(4, [&](std::size_t) {
    names.emplace_back(text.word());
    if (std::find(names.begin(), names.end() - 1, names.back()) != names.end() - 1)
      text.fail("there are two zones " + names.back());
    text.expect('{');
    while (!text.take('}')) {
      if (text.word() != "cellLabels") {
        text.entry();
        continue;
      }
      text.word(); // List<label>
      for (const local_id cell : text.labels()) {
        if (static_cast<std::size_t>(cell) >= of_cell.size())
          text.fail("zone " + names.back() + " has the cell " + std::to_string(cell) + ", and there are " +
                    std::to_string(of_cell.size()));
        if (std::exchange(of_cell[cell], static_cast<local_id>(names.size()) - 1) != no_id)
          text.fail("cell " + std::to_string(cell) + " is in two zones");
      }
      text.expect(';');
    }
  });
  text.expect_end();
  if (names.empty())
    std::fill(of_cell.begin(), of_cell.end(), 0);
  if (const auto none = std::find(of_cell.begin(), of_cell.end(), no_id); none != of_cell.end())
    text.fail("cell " + std::to_string(none - of_cell.begin()) + " is in none of the zones");
  return names;
}

} // namespace dovetail::io::detail
