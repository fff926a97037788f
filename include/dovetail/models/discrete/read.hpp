/// @file
/// Triangulated surfaces from files: STL, OBJ, OFF, PLY.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/models/discrete/soup.hpp"

#include <filesystem>
#include <string>

namespace dovetail {

/// The format by the name's ending, lower case, without the dot; empty when this library reads no triangles
/// from it.
std::string triangle_format_of(const std::filesystem::path& file);

/// Reads the triangles of an STL, OBJ, OFF or PLY file as they are; polygons become fans. O(size). Throws
/// `input_error` naming the file, and the line in text files, when it is missing, empty, truncated, foreign
/// or malformed.
triangle_soup read_triangles(const std::filesystem::path& file);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/discrete/read.ipp"
#endif
