/// @file
/// Words and numbers of a text, and what the readers of triangles fill a soup by.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"
#include "dovetail/models/discrete/soup.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::discrete {

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

} // namespace dovetail::discrete
