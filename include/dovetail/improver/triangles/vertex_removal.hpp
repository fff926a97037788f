/// @file
/// Removes an inner vertex of a surface by moving it onto a neighbour.
#pragma once

#include "dovetail/improver/triangles/operation_limits.hpp"
#include "dovetail/mesh/surface_operations.hpp"

#include <algorithm>
#include <array>

namespace dovetail::improvement {

/// The operation that moves a vertex onto a neighbour.
class vertex_removal {
public:
  static constexpr std::array names{"contraction"}; ///< for reports
  static constexpr turn when = turn::hard;          ///< it is tried in the sweeps with hard operations

  /// Tries the inner vertices of `t` until one can be removed.
  bool mend(surface_complex& mesh, local_id t, const operation_limits<2>& limits,
            const recorded_tries& tries) {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id v = mesh.table.vertex[c];
      if (mesh.inner(v) && tries([&] { return improve(mesh, v, limits); }))
        return true;
    }
    return false;
  }
  /// When that makes the worst triangle around v better by a step and no edge too long.
  bool improve(surface_complex& mesh, local_id v, const operation_limits<2>& limits) {
    if (has_large_star(mesh, v))
      return false;
    double longest = limits.longest_edge;
    mesh.table.for_each_corner(
        v, [&](local_id c) { longest = std::max(longest, mesh.relative_length(v, mesh.table.tail(c))); });
    const double required = std::max(dovetail::detail::star_quality(mesh, v), 0.0) + limits.least_step;
    if (!dovetail::detail::remove_vertex(mesh, v, required, longest, flips_))
      return false;
    flips_.raise_quality(mesh);
    return true;
  }

private:
  dovetail::detail::flip_queue flips_;
};

} // namespace dovetail::improvement
