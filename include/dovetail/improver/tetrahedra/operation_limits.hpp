/// @file
/// What operations on tetrahedra keep to.
#pragma once

#include "dovetail/improver/operation.hpp"
#include "dovetail/improver/tetrahedra/apex_search.hpp"
#include "dovetail/improver/tetrahedra/size_band.hpp"

namespace dovetail::improvement {

template <>
struct operation_limits<3> {
  float target = 0.17F;       ///< elements with a smaller value are poor
  int search_iterations = 6;  ///< linearisations per move of a vertex
  size_band band = {};        ///< of edge lengths
  bool is_last_round = false; ///< over a few stubborn elements: larger cavities, more patience

  bool is_poor(const tet_complex& mesh, local_id e) const { return mesh.value(e) < target; }
  /// The limits of the search for an apex.
  apex_search_limits search() const { return {.iterations = search_iterations, .enough = target}; }
};

} // namespace dovetail::improvement
