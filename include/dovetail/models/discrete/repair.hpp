/// @file
/// From a triangle soup to consistently oriented surfaces: closed ones that bound solids, and sheets.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/models/discrete/oriented_surfaces.hpp"
#include "dovetail/models/discrete/soup.hpp"

#include <string>

namespace dovetail {

/// What may be done to a soup.
struct repair_options {
  double merge_tolerance =
      1e-6; ///< of the diagonal; points this near are one where the surface is open otherwise
  bool allow_sheets = false; ///< surfaces may be open, for meshes of triangles
};

/// Merges points, drops degenerate and repeated triangles, orients, and finds solids and voids. Points are
/// merged when equal, and, where the surface is then still open, within `merge_tolerance` times the diagonal
/// of its box. About O(n log n) for few shells. Throws what `check_soup` throws, and `geometry_error` naming
/// `name` and the place when the surface is not manifold, one-sided or crosses itself, and, unless sheets are
/// allowed, when it is open.
oriented_surfaces repaired(const triangle_soup& soup, const std::string& name = "the surface",
                           const repair_options& options = {});

/// As `repaired`, with a warning that says how many triangles were listed twice or the wrong way round: a
/// file in which some are was damaged, and may lack others.
oriented_surfaces repaired_file(const triangle_soup& soup, const std::string& name,
                                const repair_options& options = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/discrete/repair.ipp"
#endif
