/// @file
/// What `read.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/xml_tree.hpp"
#include "dovetail/models/plane/read.hpp"
#include "dovetail/models/plane/svg_path.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>

namespace dovetail {

namespace detail {

/// Adds the paths of an SVG element and of all that it contains.
inline void add_svg_paths(const xml_element& element, double chord_error, plane_drawing& drawing) {
  constexpr std::array<std::string_view, 7> not_read{"rect",     "circle", "ellipse", "polygon",
                                                     "polyline", "line",   "use"};
  if (std::find(not_read.begin(), not_read.end(), element.name) != not_read.end())
    throw input_error(std::string(element.name) + " elements are not read; convert them to paths");
  if (!element.attribute("transform").empty())
    throw input_error("a transform is not supported; apply it to the paths");
  if (element.name == "path") {
    const plane_drawing paths = drawing_from_svg_path(
        element.attribute("d"), {.chord_error = chord_error,
                                 .open_paths_are_lines = element.attribute("fill") == "none",
                                 .name = xml_unescaped(element.attribute("id"))});
    append(drawing.polygons, paths.polygons);
    append(drawing.lines, paths.lines);
  }
  for (const xml_element& child : element.children)
    add_svg_paths(child, chord_error, drawing);
}

} // namespace detail

DOVETAIL_INLINE plane_drawing read_svg(const std::filesystem::path& file, double chord_error) {
  const std::string content = read_file(file);
  const xml_element root = xml_parser(content, file.string()).parse();
  plane_drawing drawing;
  try {
    detail::add_svg_paths(root, chord_error, drawing);
  } catch (const input_error& problem) {
    throw input_error(file.string() + ": " + problem.what());
  } catch (const geometry_error& problem) {
    throw geometry_error(file.string() + ": " + problem.what());
  }
  if (drawing.polygons.empty())
    throw input_error(file.string() + ": there is no closed path in this file");
  return drawing;
}

DOVETAIL_INLINE plane_drawing read_polygons(const std::filesystem::path& file) {
  std::istringstream in(read_file(file));
  plane_drawing drawing;
  plane_path* path = nullptr;
  std::string row;
  for (int line = 1; std::getline(in, row); ++line) {
    std::istringstream words(row.substr(0, row.find('#')));
    const auto fail = [&](const std::string& what) {
      throw input_error(file.string() + ", line " + std::to_string(line) + ": " + what);
    };
    std::string first, second, rest;
    if (!(words >> first))
      continue;
    words >> second;
    if (first == "polygon" || first == "line") {
      auto& paths = first == "polygon" ? drawing.polygons : drawing.lines;
      paths.push_back({{}, second});
      path = &paths.back();
      continue;
    }
    if (path == nullptr)
      fail("points come after a line that says 'polygon' or 'line'");
    char *end_x = nullptr, *end_y = nullptr;
    const vec2 p{std::strtod(first.c_str(), &end_x), std::strtod(second.c_str(), &end_y)};
    if (second.empty() || *end_x != 0 || *end_y != 0 || (words >> rest))
      fail("two numbers are expected, the coordinates of a point");
    path->points.push_back(p);
  }
  if (drawing.polygons.empty())
    throw input_error(file.string() + ": there is no polygon in this file");
  return drawing;
}

} // namespace dovetail
