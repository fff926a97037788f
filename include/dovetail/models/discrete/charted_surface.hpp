/// @file
/// Triangulated surfaces cut into charts.
#pragma once

#include "dovetail/geometry/frame.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <vector>

namespace dovetail {

/// The surfaces with triangles split where charts end, and the charts.
struct charted_surface {
  simplicial_mesh<2> mesh;         ///< with split triangles
  std::vector<local_id> smooth_of; ///< per triangle: the smooth area; it changes across feature edges
  std::vector<local_id> chart_of;  ///< per triangle; numbered in the order of their first triangles
  std::vector<local_id> group_of;  ///< per triangle: named group of the file, or no_id
  std::vector<local_id> solid_of;  ///< per triangle: the solid behind it; no_id in sheets
  std::vector<local_id> front_of;  ///< per triangle: the solid in front of it; no_id where there is none
  std::vector<discrete::chart_frame> frames; ///< per chart
  std::vector<local_id> corners = {};        ///< points where curves end, whatever their angle

  /// All that is known per triangle.
  std::array<std::vector<local_id>*, 5> of_triangles() {
    return {&smooth_of, &chart_of, &group_of, &solid_of, &front_of};
  }
};

} // namespace dovetail
