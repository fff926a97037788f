/// @file
/// Triangles as a file gives them, before anything about them is known.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <string>
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
void check_soup(const triangle_soup& soup, const std::string& name);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/discrete/soup.ipp"
#endif
