/// @file
/// Triangles as a file gives them, before anything about them is known; and the text scanner of the readers.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail {

/// Triangles on points that may repeat, in any orientation.
struct triangle_soup {
  std::vector<vec3> points;          ///< as listed
  std::vector<simplex<2>> triangles; ///< by the numbers of points
  /// Per triangle: its group, an index into `group_names`; without names any number of one's own; or no_id.
  /// Empty: none has a group.
  std::vector<local_id> groups = {};
  std::vector<std::string> group_names = {}; ///< named solids or groups of the file
};

/// Throws `geometry_error` naming `name` and the triangle or point when arrays disagree in length, a triangle
/// refers to a point or group that does not exist, or a point is not finite. O(n).
inline void check_soup(const triangle_soup& soup, const std::string& name) {
  if (!soup.groups.empty() && soup.groups.size() != soup.triangles.size())
    throw geometry_error(name + ": there are " + std::to_string(soup.groups.size()) + " groups or ids for " +
                         std::to_string(soup.triangles.size()) +
                         " triangles; give one per triangle, or none");
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    if (const vec3 p = soup.points[i]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw geometry_error(name + ": point " + std::to_string(i) + " is not finite");
  const auto is_index = [](local_id i, std::size_t size) {
    return i >= 0 && static_cast<std::size_t>(i) < size;
  };
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (const local_id v : soup.triangles[t])
      if (!is_index(v, soup.points.size()))
        throw geometry_error(name + ": triangle " + std::to_string(t) + " refers to point " +
                             std::to_string(v) + ", but there are " + std::to_string(soup.points.size()) +
                             " points");
  if (!soup.group_names.empty())
    for (std::size_t t = 0; t < soup.groups.size(); ++t)
      if (soup.groups[t] != no_id && !is_index(soup.groups[t], soup.group_names.size()))
        throw geometry_error(name + ": triangle " + std::to_string(t) + " refers to group " +
                             std::to_string(soup.groups[t]) + ", but there are " +
                             std::to_string(soup.group_names.size()) + " names of groups");
}

namespace discrete {

/// Reads words and numbers off a text, line by line, and names file and line when something is wrong.
class text_scanner {
public:
  text_scanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// Moves to the next line that is neither empty nor a comment; false at the end.
  bool next_line(std::string_view comment = "#") {
    while (at_ < text_.size()) {
      const std::size_t end = text_.find('\n', at_);
      line_text_ = text_.substr(at_, end == std::string_view::npos ? std::string_view::npos : end - at_);
      at_ = end == std::string_view::npos ? text_.size() : end + 1;
      ++line_;
      skip_blanks();
      if (!line_text_.empty() && !line_text_.starts_with(comment))
        return true;
    }
    line_text_ = {};
    return false;
  }

  /// The next word of the line; empty at its end.
  std::string_view word() {
    skip_blanks();
    std::size_t end = 0;
    while (end < line_text_.size() && !is_blank(line_text_[end]))
      ++end;
    const std::string_view found = line_text_.substr(0, end);
    line_text_.remove_prefix(end);
    return found;
  }
  /// What is left of the line, without blanks around it.
  std::string_view rest() {
    skip_blanks();
    while (!line_text_.empty() && is_blank(line_text_.back()))
      line_text_.remove_suffix(1);
    return line_text_;
  }
  bool at_line_end() { return rest().empty(); } ///< whether no word is left on the line

  /// The next word of the line as a finite number.
  double number() {
    const std::string_view found = word();
    double value = 0;
    const char* first = found.data();
    if (!found.empty() && found.front() == '+')
      ++first;
    const auto [end, failure] = std::from_chars(first, found.data() + found.size(), value);
    if (found.empty() || failure != std::errc() || end != found.data() + found.size() ||
        !std::isfinite(value))
      fail("a finite number is expected instead of \"" + std::string(found) + "\"");
    return value;
  }
  /// Three numbers.
  vec3 point() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  /// A whole number. Throws `input_error` when it is none.
  long integer() {
    const double value = number();
    if (value != std::floor(value) || std::abs(value) > 4e9)
      fail("a whole number is expected instead of " + number_text(value));
    return static_cast<long>(value);
  }

  /// Throws `input_error` that names file and line.
  [[noreturn]] void fail(const std::string& what) const {
    throw input_error(file_ + ":" + std::to_string(line_) + ": " + what);
  }

private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip_blanks() {
    while (!line_text_.empty() && is_blank(line_text_.front()))
      line_text_.remove_prefix(1);
  }

  std::string_view text_;
  std::string file_;
  std::string_view line_text_ = {};
  std::size_t at_ = 0;
  std::size_t line_ = 0;
};

/// Appends a polygon as a fan of triangles; indices are checked by the caller.
inline void append_polygon(triangle_soup& soup, const std::vector<local_id>& corners, local_id group) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    soup.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    soup.groups.push_back(group);
  }
}

/// Numbers the groups of a soup by their names; O(log n) each, since a file may have as many as triangles.
class group_numbering {
public:
  explicit group_numbering(triangle_soup& soup) : soup_(soup) {}

  /// The index of a name, which is added when it is new; none for no name.
  local_id operator()(std::string_view name) {
    if (name.empty())
      return no_id;
    const auto [place, added] =
        known_.try_emplace(std::string(name), static_cast<local_id>(soup_.group_names.size()));
    if (added)
      soup_.group_names.emplace_back(name);
    return place->second;
  }

private:
  triangle_soup& soup_;
  std::map<std::string, local_id> known_;
};

} // namespace discrete
} // namespace dovetail
