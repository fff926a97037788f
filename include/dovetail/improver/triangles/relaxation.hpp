/// @file
/// The cheap part for a whole surface: flips and smoothing of everything.
#pragma once

#include "dovetail/improver/triangles/side_flip.hpp"
#include "dovetail/improver/triangles/triangle_smoothing.hpp"
#include "dovetail/mesh/surface_smoothing.hpp"

#include <cstddef>

namespace dovetail::improvement {

/// Flips and moves all that may be flipped and moved.
class relaxation {
public:
  /// `log` counts flips and moves under the names of the operations.
  relaxation(surface_complex& mesh, operation_log& log)
      : mesh_(mesh), smooth_(mesh), flips_(log, log.add(side_flip::names)),
        moves_(log, log.add(triangle_smoothing::names)) {}

  /// Passes over all free vertices, with flips before and after each, until nothing moves any more.
  void run(int passes) {
    flip_everywhere();
    for (int pass = 0; pass < passes; ++pass) {
      std::size_t moved = 0;
      for (local_id v = mesh_.frozen; v < static_cast<local_id>(mesh_.point.size()); ++v)
        if (mesh_.table.corner_of[v] != no_id)
          moved += moves_([&] { return smooth_.relax(v); });
      if (moved == 0)
        break;
      flip_everywhere();
    }
  }

private:
  void flip_everywhere() {
    for (local_id c = 0; c < static_cast<local_id>(mesh_.table.vertex.size()); ++c)
      if (mesh_.table.vertex[c] != no_id && mesh_.table.twin[c] > c)
        flips_([&] { return flip_.improve(mesh_, c); });
  }

  surface_complex& mesh_;
  side_flip flip_;
  dovetail::detail::smoother<surface_complex> smooth_;
  recorded_tries flips_, moves_;
};

} // namespace dovetail::improvement
