/// @file
/// Flips sides of triangles where that raises the worse of the two; the edge removal of two dimensions.
#pragma once

#include "dovetail/improver/triangles/operation_limits.hpp"
#include "dovetail/mesh/surface_operations.hpp"

#include <array>

namespace dovetail::improvement {

/// The operation that flips sides of a triangle.
class side_flip {
public:
  static constexpr std::array names{"edge removal"}; ///< for reports
  static constexpr turn when = turn::always;         ///< it is tried in all sweeps

  /// Tries the sides of `t` as long as it is poor.
  bool mend(surface_complex& mesh, local_id t, const operation_limits<2>& limits,
            const recorded_tries& tries) {
    bool helped = false;
    for (local_id c = 3 * t; c < 3 * t + 3 && limits.is_poor(mesh, t); ++c)
      helped = tries([&] { return improve(mesh, c); }) || helped;
    return helped;
  }
  /// Flips the side opposite corner c, if that helps, and those around it that can then be flipped.
  bool improve(surface_complex& mesh, local_id c) {
    flips_.push(c);
    return flips_.raise_quality(mesh) > 0;
  }

private:
  dovetail::detail::flip_queue flips_;
};

} // namespace dovetail::improvement
