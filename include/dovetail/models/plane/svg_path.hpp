/// @file
/// The path data of SVG as a drawing: commands M L H V C Q A Z in upper and lower case, curves flattened.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/models/plane/drawing.hpp"

#include <string>
#include <string_view>

namespace dovetail {

/// Parameters of `drawing_from_svg_path`.
struct svg_path_options {
  /// Largest distance between a curve and its chords, in the path's unit; 0: 1e-4 of the control points' box.
  double chord_error = 0;
  bool open_paths_are_lines = false; ///< false: a subpath without Z is an error
  std::string name = {};             ///< of the paths, for messages
};

/// The subpaths of a path as polygons (and lines). Coordinates are those of the data; SVG's y axis points
/// down, so pictures look mirrored. Throws `input_error` for data that are no path, `geometry_error` for an
/// open one.
/// Linear in the segments made.
/// \param data the attribute `d` of a path
/// \param options how far chords may be from curves, and what open paths are
plane_drawing drawing_from_svg_path(std::string_view data, const svg_path_options& options = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/plane/svg_path.ipp"
#endif
