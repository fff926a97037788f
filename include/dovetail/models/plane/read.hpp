/// @file
/// Plane drawings from files: the paths of an SVG file, or a plain list of points.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/models/plane/drawing.hpp"

#include <filesystem>

namespace dovetail {

/// The `path` elements of an SVG file. A path with fill="none" is a line where it is open; all other subpaths
/// must be closed. Other shapes and transformations are refused rather than left out. Throws `input_error`
/// naming the file.
/// \param chord_error how far chords may be from curves, in the units of the file; 0: 1e-4 of the box
/// Linear in the segments made.
/// \param file SVG
plane_drawing read_svg(const std::filesystem::path& file, double chord_error = 0);

/// A list of points, one "x y" per line, under headings "polygon [name]" or "line [name]"; # starts a
/// comment. Throws `input_error` naming the file and the line.
/// Linear.
/// \param file text
plane_drawing read_polygons(const std::filesystem::path& file);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/plane/read.ipp"
#endif
