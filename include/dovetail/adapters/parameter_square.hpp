/// @file
/// The parameter plane as meshers of the plane want it: axes that resemble lengths, and an extent near 1.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplex.hpp"
#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/surfaces.hpp"

#include <vector>

namespace dovetail::detail {

/// The loops of a patch on coordinates where the parameters resemble lengths and the largest extent is 1,
/// which suits libraries' absolute tolerances.
struct parameter_square {
  std::vector<vec2> xy; ///< of the boundary's vertices
  vec2 scale{1, 1};     ///< parameters times this, less `lower`, are xy
  vec2 lower{0, 0};

  parameter_square(const any_surface& surface, const patch_boundary& boundary);

  vec2 uv(vec2 p) const { return {(p.x + lower.x) / scale.x, (p.y + lower.y) / scale.y}; }

  /// Whether two corners of a triangle of the square are the same point of a pole: then it is none in space.
  bool vanishes(const simplex<2>& t, const patch_boundary& boundary) const;

private:
  std::vector<local_id> poles_; ///< labels, sorted: of segments that join a label to itself
};

} // namespace dovetail::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/adapters/parameter_square.ipp"
#endif
