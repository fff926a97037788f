/// @file
/// Wavefront OBJ and OFF.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/models/discrete/soup.hpp"
#include "dovetail/models/discrete/text_scanner.hpp"

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::discrete {

/// The vertex of one corner of an OBJ face, "7", "7/1" or "7//3"; negative numbers count from the last
/// vertex.
inline local_id obj_corner(std::string_view word, std::size_t points, const text_scanner& in) {
  const std::string_view digits = word.substr(0, word.find('/'));
  long index = 0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (failure != std::errc() || end != digits.data() + digits.size())
    in.fail("a vertex number is expected instead of \"" + std::string(word) + "\"");
  const long zero_based = index < 0 ? static_cast<long>(points) + index : index - 1;
  if (zero_based < 0 || zero_based >= static_cast<long>(points))
    in.fail("the face refers to vertex " + std::to_string(index) + ", and there are " +
            std::to_string(points));
  return static_cast<local_id>(zero_based);
}

/// Vertices and faces; the 'g' and 'o' of the file become groups; everything else is ignored.
inline triangle_soup parse_obj(std::string_view data, const std::string& file) {
  triangle_soup soup;
  text_scanner in(data, file);
  group_numbering group_of(soup);
  local_id group = no_id;
  std::vector<local_id> corners;
  while (in.next_line()) {
    const std::string_view key = in.word();
    if (key == "v") {
      soup.points.push_back(in.point());
    } else if (key == "g" || key == "o") {
      group = group_of(in.rest());
    } else if (key == "f") {
      corners.clear();
      while (!in.at_line_end())
        corners.push_back(obj_corner(in.word(), soup.points.size(), in));
      if (corners.size() < 3)
        in.fail("a face with " + std::to_string(corners.size()) + " corners");
      append_polygon(soup, corners, group);
    }
  }
  if (soup.triangles.empty())
    throw input_error(file + ": no face found; this is not an OBJ file, or it is truncated");
  return soup;
}

/// The triangles of an OFF file; polygons are cut into triangles. Throws `input_error` naming file and line.
inline triangle_soup parse_off(std::string_view data, const std::string& file) {
  triangle_soup soup;
  text_scanner in(data, file);
  if (!in.next_line() || in.word() != "OFF")
    in.fail("this is not an OFF file: \"OFF\" is expected first");
  if (in.at_line_end() && !in.next_line())
    in.fail("the OFF file is truncated: the counts are missing");
  const long points = in.integer();
  const long faces = in.integer();
  const auto required_line = [&](const char* what) {
    if (!in.next_line())
      in.fail(std::string("the OFF file is truncated: ") + what + " are missing");
  };
  for (long i = 0; i < points; ++i) {
    required_line("vertices");
    soup.points.push_back(in.point());
  }
  std::vector<local_id> corners;
  for (long f = 0; f < faces; ++f) {
    required_line("faces");
    const long count = in.integer();
    if (count < 3)
      in.fail("a face with " + std::to_string(count) + " corners");
    corners.clear();
    for (long k = 0; k < count; ++k) {
      const long index = in.integer();
      if (index < 0 || index >= points)
        in.fail("the face refers to vertex " + std::to_string(index) + ", and there are " +
                std::to_string(points));
      corners.push_back(static_cast<local_id>(index));
    }
    append_polygon(soup, corners, no_id);
  }
  return soup;
}

} // namespace dovetail::discrete
