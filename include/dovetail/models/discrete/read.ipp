/// @file
/// What `read.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/models/discrete/obj_off.hpp"
#include "dovetail/models/discrete/ply.hpp"
#include "dovetail/models/discrete/read.hpp"
#include "dovetail/models/discrete/stl.hpp"

#include <cctype>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>

namespace dovetail {

DOVETAIL_INLINE std::string triangle_format_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* known : {"stl", "obj", "off", "ply"})
    if (ending == std::string(".") + known)
      return known;
  return {};
}

DOVETAIL_INLINE triangle_soup read_triangles(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string format = triangle_format_of(file);
  if (format.empty())
    throw input_error(name + ": unknown kind of surface file; known are .stl, .obj, .off, .ply");
  const std::string data = read_file(file);
  triangle_soup soup = format == "stl"   ? discrete::parse_stl(data, name)
                       : format == "obj" ? discrete::parse_obj(data, name)
                       : format == "off" ? discrete::parse_off(data, name)
                                         : discrete::parse_ply(data, name);
  if (soup.points.size() > static_cast<std::size_t>(std::numeric_limits<local_id>::max()))
    throw input_error(name + ": the file has more corners than can be numbered; divide it");
  if (soup.triangles.empty())
    throw input_error(name + ": the file has no triangle");
  return soup;
}

} // namespace dovetail
