/// @file
/// Triangulated surfaces that bound solids or are sheets: what geometry models of triangles are made of.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <string>
#include <vector>

namespace dovetail {

/// What the repair of a triangle soup has found and done.
struct repair_counts {
  std::size_t merged_points = 0; ///< points that became another one
  std::size_t degenerate = 0;    ///< triangles that were dropped
  std::size_t duplicates = 0;    ///< likewise
  std::size_t flipped_caps = 0;  ///< flat triangles that exchanged an edge
  std::size_t turned = 0;        ///< triangles that were listed the wrong way round
  std::size_t shells = 0;        ///< closed surfaces
  std::size_t sheets = 0;        ///< open ones
  local_id solids = 0;           ///< that the closed surfaces bound
  local_id voids = 0;            ///< closed surfaces that bound a void

  using fields =
      field_list<&repair_counts::merged_points, &repair_counts::degenerate, &repair_counts::duplicates,
                 &repair_counts::flipped_caps, &repair_counts::turned, &repair_counts::shells,
                 &repair_counts::sheets, &repair_counts::solids, &repair_counts::voids>;
};

/// Surfaces in which an edge has two triangles that pass it in opposite directions, one where it is the
/// boundary of a sheet, or more where surfaces between solids meet. The normals of closed surfaces point out
/// of the material behind them, those of a sheet to the side that most of its triangles were listed with.
struct oriented_surfaces {
  simplicial_mesh<2> mesh;      ///< tags are surfaces
  std::vector<local_id> groups; ///< per triangle: index into `group_names`, or no_id
  std::vector<std::string> group_names;
  std::vector<local_id> group_numbers; ///< per group: its number in the soup
  std::vector<local_id> solid_of;      ///< per triangle: the solid behind it; no_id in sheets
  std::vector<local_id> front_of;      ///< per triangle: the solid in front of it; empty: nowhere is one
  local_id solids = 0;                 ///< how many the closed surfaces bound
  std::vector<local_id> corners = {};  ///< points where curves end, whatever their angle
  report repairs;                      ///< `repair_counts`
};

namespace discrete {

/// Groups that are numbers of one's own become indices; their names are the numbers.
void name_groups_by_numbers(oriented_surfaces& surfaces);

} // namespace discrete
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/discrete/oriented_surfaces.ipp"
#endif
