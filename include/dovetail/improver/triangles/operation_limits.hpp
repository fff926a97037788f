/// @file
/// What operations on triangles keep to.
#pragma once

#include "dovetail/improver/operation.hpp"
#include "dovetail/improver/triangles/surface_complex.hpp"

namespace dovetail::improvement {

template <>
struct operation_limits<2> {
  double target = 0.33;     ///< triangles with a smaller quality (sin^2 of the smallest angle) are poor
  double longest_edge = 2;  ///< removing a vertex makes no edge longer than this times the target length
  double least_step = 0.01; ///< of quality, for operations that add or remove a vertex

  /// Whether a triangle is there and below the target.
  bool is_poor(const surface_complex& mesh, local_id t) const {
    return mesh.table.alive(t) && mesh.quality(t) < target;
  }
};

} // namespace dovetail::improvement
