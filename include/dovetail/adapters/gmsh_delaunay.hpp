/// @file
/// Gmsh's own Delaunay refinement (`Mesh.Algorithm3D = 1`), in a child process.
#pragma once

#include "dovetail/adapters/gmsh_session.hpp"

namespace dovetail::mesher {

/// A model of `boundary_keeping_mesher<3>`. What is said of processes at `gmsh_hxt` holds here too.
///
/// Gmsh is given 0.72 times the size: on a uniform field that makes the mean edge h within 1 % (cube of
/// 31,000 and sphere of 110,000 elements).
struct gmsh_delaunay {
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = false,
                                        .accepts_non_manifold = false,
                                        .repeats_in_process = true, // each call has a process of its own
                                        .may_crash = false};

  /// Elements made per unit of the integral of h^-3.
  static constexpr double elements_per_inverse_cubed_size = 11.2;
  /// What Gmsh is told over the size wanted, for a mean edge of h on uniform fields.
  static constexpr double calibration = 0.72;

  double optimise_threshold = 0.3; ///< Gmsh's `Mesh.OptimizeThreshold`, 0 to 1: higher is slower
  double size_scale = 1.0;         ///< multiplies the field
  double limit_seconds = 3600;     ///< the child's wall clock; the last resort

  /// Meshes the inside of `input.boundary`. Throws `mesher_error` when Gmsh fails or its result fails the
  /// checks; `sizing_error` when the field gives an unusable size.
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    detail::gmsh_settings settings;
    settings.name = "Gmsh Delaunay";
    settings.algorithm = 1;
    settings.size_factor = calibration * size_scale;
    settings.optimise_threshold = optimise_threshold;
    settings.limit_seconds = limit_seconds;
    return detail::mesh_with_gmsh(settings, input, size);
  }
};

static_assert(boundary_keeping_mesher<gmsh_delaunay, 3>);

} // namespace dovetail::mesher
