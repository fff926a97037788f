/// @file
/// Moves a vertex of a surface to where the worst triangle around it is best.
#pragma once

#include "dovetail/improver/triangles/operation_limits.hpp"
#include "dovetail/mesh/surface_smoothing.hpp"

#include <array>

namespace dovetail::improvement {

/// The operation that moves the vertices of a triangle.
class triangle_smoothing {
public:
  static constexpr std::array names{"smoothing"}; ///< for reports
  static constexpr turn when = turn::always;      ///< it is tried in all sweeps

  explicit triangle_smoothing(surface_complex& mesh) : smooth_(mesh) {}

  /// Moves the inner vertices of `t` in turn as long as it is poor.
  bool mend(surface_complex& mesh, local_id t, const operation_limits<2>& limits,
            const recorded_tries& tries) {
    bool helped = false;
    for (local_id c = 3 * t; c < 3 * t + 3 && limits.is_poor(mesh, t); ++c)
      if (const local_id v = mesh.table.vertex[c]; mesh.inner(v) && !has_large_star(mesh, v))
        helped = tries([&] { return smooth_.maximise_worst(v, limits.target); }) || helped;
    return helped;
  }

private:
  dovetail::detail::smoother<surface_complex> smooth_;
};

} // namespace dovetail::improvement
