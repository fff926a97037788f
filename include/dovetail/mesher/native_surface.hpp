/// @file
/// The surface remesher as a mesher of D = 2: the default for pieces of CAD surfaces and of plane domains.
#pragma once

#include "dovetail/mesher/region_assembly.hpp"
#include "dovetail/remesh/patch_remesher.hpp"

namespace dovetail::mesher {

/// Fills every region of a piece by `remesh::patch_remesher`.
struct native_surface {
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = true,
                                        .accepts_non_manifold = true,
                                        .repeats_in_process = true,
                                        .may_crash = false};

  remesh::patch_remesher remesher = {};

  /// About linear in the number of triangles made. Throws `mesher_error` naming the face whose lines cross.
  mesher_result<2> operator()(const mesher_input<2>& input, const any_sizing& size) const {
    const stopwatch clock;
    auto result = assemble_regions(input, [&](const any_surface& surface, const patch_boundary& boundary) {
      return surface.plane ? remesher(*surface.plane, boundary, size) : remesher(surface, boundary, size);
    });
    result.summary.seconds = clock.seconds();
    return result;
  }
};
static_assert(boundary_keeping_mesher<native_surface, 2>);

} // namespace dovetail::mesher
