/// @file
/// From a surface mesher, which fills one region of one surface, to a mesher of pieces of D = 2.
#pragma once

#include "dovetail/mesher/region_assembly.hpp"
#include "dovetail/remesh/concepts.hpp"

namespace dovetail::mesher {

/// Fills every region of a piece by M, regions on planes without calls through `any_surface`.
template <surface_mesher M>
  requires surface_mesher<M, any_surface>
struct by_regions {
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = is_thread_safe<M>(),
                                        .accepts_non_manifold = true,
                                        .repeats_in_process = true,
                                        .may_crash = false};

  M remesher = {};

  /// Costs what M does. Throws `mesher_error` naming the face whose lines cross, and what M throws.
  mesher_result<2> operator()(const mesher_input<2>& input, const any_sizing& size) const {
    const stopwatch clock;
    const auto mesh_region = [&](const any_surface& surface, const patch_boundary& boundary,
                                 const any_sizing& inner) {
      return surface.plane ? remesher(*surface.plane, boundary, inner) : remesher(surface, boundary, inner);
    };
    auto result = assemble_regions(input, size, mesh_region);
    result.summary.seconds = clock.seconds();
    return result;
  }
};

} // namespace dovetail::mesher
