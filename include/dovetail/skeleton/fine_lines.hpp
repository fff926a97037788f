/// @file
/// The numbers of the points on the fine skeleton's lines: coarse skeleton vertices first, then the points
/// inside the lines in the lines' order. Regions and faces name their boundaries by these numbers.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/parallel/kept.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// The points between the two ends of a line, in key order.
struct fine_line {
  std::vector<vec3> points; ///< in the order of the line
  std::vector<double> t;    ///< curve parameters, for a line on a CAD curve
  std::vector<vec2> uv;     ///< face parameters, for a line on a CAD face

  using fields = field_list<&fine_line::points, &fine_line::t, &fine_line::uv>;
};

/// The lines of a skeleton, in its order.
struct remeshed_lines {
  std::vector<fine_line> lines;       ///< their points
  std::vector<kept<fine_line>> names; ///< of what these are a function of; may be empty
};

/// Remeshed lines with numbered points.
struct numbered_lines {
  std::vector<skeleton_line> keys;              ///< as in the coarse skeleton
  std::vector<fine_line> lines;                 ///< in their order, as in the coarse skeleton
  std::vector<kept<fine_line>> names;           ///< likewise; may be empty
  std::vector<local_id> first_point;            ///< per line: number of its first inner point
  std::vector<local_id> number_of_coarse_point; ///< no_id where the coarse point is not on the skeleton
  std::vector<vec3> points;                     ///< by their number
  std::vector<host> hosts;                      ///< {3, no_id} inside the domain

  /// The numbers along a line, both ends included, from coarse vertex `from`.
  std::vector<local_id> along(local_id line, local_id from) const;
  /// The number of a point of the coarse skeleton.
  local_id number_of(local_id coarse_point) const { return number_of_coarse_point[coarse_point]; }
};

/// Numbers the points of remeshed lines. `coarse_hosts` may be shorter than `coarse_points`: the others lie
/// inside.
/// Linear. Throws nothing but for a lack of memory.
/// \param skeleton the coarse skeleton
/// \param lines one per line of the skeleton
/// \param coarse_points of the background mesh
/// \param coarse_hosts the CAD entity of each coarse point
/// \param before lines that are not needed any more, whose memory is used again
numbered_lines number_lines(const coarse_skeleton& skeleton, remeshed_lines lines,
                            std::span<const vec3> coarse_points, std::span<const host> coarse_hosts,
                            numbered_lines before = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/fine_lines.ipp"
#endif
