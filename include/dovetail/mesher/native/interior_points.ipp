/// @file
/// What `interior_points.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/native/interior_points.hpp"
#include "dovetail/mesher/native/lattice_growth.hpp"
#include "dovetail/mesher/native/piece_octree.hpp"
#include "dovetail/mesher/native/straight_lattice.hpp"

#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<vec3> interior_points(const simplicial_mesh<2>& boundary, const any_sizing& size,
                                                  const interior_point_options& options) {
  require_enclosing(boundary);
  const detail::piece_octree piece(boundary, size, options);
  if (piece.is_uniform())
    return detail::straight_lattice(piece, options);
  detail::lattice_growth growth(piece, options);
  growth.grow();
  return growth.take();
}

} // namespace dovetail
