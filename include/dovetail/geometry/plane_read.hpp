/// @file
/// Plane drawings from files: the paths of an SVG file, or a plain list of points.
#pragma once

#include "dovetail/geometry/plane_svg_path.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace dovetail {

namespace detail {

inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw input_error(file.string() + ": the file cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The value of an attribute inside a tag, or nothing.
inline std::string_view svg_attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    const bool starts = at > 0 && std::isspace(static_cast<unsigned char>(tag[at - 1])) != 0;
    std::size_t next = at + name.size();
    while (next < tag.size() && std::isspace(static_cast<unsigned char>(tag[next])) != 0)
      ++next;
    if (!starts || next >= tag.size() || tag[next] != '=')
      continue;
    const std::size_t open = tag.find_first_of("'\"", next);
    const std::size_t close = open == std::string_view::npos ? open : tag.find(tag[open], open + 1);
    if (close != std::string_view::npos)
      return tag.substr(open + 1, close - open - 1);
  }
  return {};
}

} // namespace detail

/// The <path> elements of an SVG file. A path with fill="none" is a line where it is open; all other subpaths
/// must be closed. Other shapes and transformations are refused rather than left out. Throws `input_error`
/// naming the file.
inline plane_drawing read_svg(const std::filesystem::path& file, double chord_error = 0) {
  const std::string text = detail::file_text(file);
  plane_drawing drawing;
  try {
    for (std::size_t open = text.find('<'); open != std::string::npos; open = text.find('<', open + 1)) {
      if (text.compare(open, 4, "<!--") == 0) {
        open = std::min(text.find("-->", open), text.size() - 1);
        continue;
      }
      const std::size_t close = std::min(text.find('>', open), text.size());
      const std::string_view tag = std::string_view(text).substr(open, close - open);
      for (const char* shape : {"<rect", "<circle", "<ellipse", "<polygon", "<polyline", "<line ", "<use"})
        if (tag.starts_with(shape))
          throw input_error(std::string(shape + 1) + " elements are not read; convert them to paths");
      if (!detail::svg_attribute(tag, "transform").empty())
        throw input_error("a transform is not supported; apply it to the paths");
      if (!tag.starts_with("<path"))
        continue;
      const plane_drawing paths =
          drawing_from_svg_path(detail::svg_attribute(tag, "d"),
                                {.chord_error = chord_error,
                                 .open_paths_are_lines = detail::svg_attribute(tag, "fill") == "none",
                                 .name = std::string(detail::svg_attribute(tag, "id"))});
      drawing.polygons.insert(drawing.polygons.end(), paths.polygons.begin(), paths.polygons.end());
      drawing.lines.insert(drawing.lines.end(), paths.lines.begin(), paths.lines.end());
    }
  } catch (const input_error& problem) {
    throw input_error(file.string() + ": " + problem.what());
  } catch (const geometry_error& problem) {
    throw geometry_error(file.string() + ": " + problem.what());
  }
  if (drawing.polygons.empty())
    throw input_error(file.string() + ": there is no closed path in this file");
  return drawing;
}

/// A list of points, one "x y" per line, under headings "polygon [name]" or "line [name]"; # starts a
/// comment. Throws `input_error` naming the file and the line.
inline plane_drawing read_polygons(const std::filesystem::path& file) {
  std::istringstream in(detail::file_text(file));
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
