/// @file
/// Faces that meet smoothly become one where the edge between them is of no use at the size.
#pragma once

#include "dovetail/models/virtual/composite_chart.hpp"
#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/models/virtual/face_triangles.hpp"
#include "dovetail/models/virtual/short_edges.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"

#include <vector>

namespace dovetail::virtual_topology {

/// A face that several of the model are.
struct composite_face {
  local_id host = no_id;         ///< the member whose number it has
  std::vector<local_id> members; ///< growing
  composite_chart chart;         ///< its parameter plane
};

/// Joins a face with one that it goes on into smoothly, within 10 degrees all along, where one of the two is
/// narrower than the limit everywhere or has no longer edges, or the edge between them is not longer. Not
/// faces of different groups, names or solids, nor faces with seams or poles, nor in thin walls, nor those
/// that turn by more than an angle within the limit, such as a fillet, nor where the whole could not be seen
/// from one direction. The largest member keeps its number, the others have no loops any more. Some thousand
/// queries of the model for each face that may be joined.
/// \param topology the topology, nothing of which is taken away any more after this
/// \param allowed limits, and faces that stay
/// \param most_turn_deg the angle, as curvature times the limit
/// \param uv where boundaries are in the parameter planes of the model's faces
/// \param found those with another number now are appended
std::vector<composite_face> join_faces(editable_topology& topology, const limits& allowed,
                                       double most_turn_deg, const uv_of_passage& uv,
                                       std::vector<suppressed_detail>& found);

} // namespace dovetail::virtual_topology

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual/composite_faces.ipp"
#endif
