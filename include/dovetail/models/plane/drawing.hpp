/// @file
/// What a plane domain is made from: closed polygons and open lines, and the checks that they must pass.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/vector.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail {

/// A polygon (closed: the last point is joined to the first, and not repeated) or an open line.
struct plane_path {
  std::vector<vec2> points; ///< in order
  std::string name = {};    ///< of the curves that it becomes; may be empty
};

/// Polygons bound the domain: what lies inside an odd number of them is meshed, so a polygon in another one
/// is a hole, and one in that hole an island. Lines lie inside the domain; the mesh has edges along them.
/// Paths may touch in common points only.
struct plane_drawing {
  std::vector<plane_path> polygons; ///< closed
  std::vector<plane_path> lines;    ///< open
};

namespace detail {

/// How messages call a path; lines are counted after the polygons.
std::string name_of_path(const plane_drawing& drawing, std::size_t path);
/// "(x, y)", for messages.
std::string text_of(vec2 p);
/// Of a polygon, positive when it is counter-clockwise.
double signed_area(const std::vector<vec2>& polygon);

} // namespace detail

/// Throws `geometry_error` that names the path and its points when a drawing bounds no proper domain: too few
/// or repeated points, a polygon without area, paths that cross or overlap.
/// Complexity: each segment is compared with those near it.
/// \param drawing polygons and lines
void check_drawing(const plane_drawing& drawing);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/plane/drawing.ipp"
#endif
