/// @file
/// Gmsh's HXT: Delaunay meshing made for many threads, here on one thread of a child process.
#pragma once

#include "dovetail/adapters/gmsh_session.hpp"

namespace dovetail::mesher {

/// A model of `boundary_keeping_mesher<3>`.
///
/// Gmsh is given 0.68 times the size: on a uniform field that makes the mean edge h within 1 % and 11.4
/// elements per h^3 (measured on cubes and spheres of 0.1 to 0.5 million elements).
///
/// Gmsh has one global state, and HXT's result depends on what the process did before: so each call forks a
/// child with fresh memory, which is the only one to call Gmsh, and takes the mesh over from it. The
/// calling process must have one thread only (`usage_error` otherwise). A crash or hang of Gmsh ends in a
/// `mesher_error`.
struct gmsh_hxt {
  static constexpr mesher_traits traits{.keeps_boundary = true,
                                        .thread_safe = false,
                                        .accepts_non_manifold = false,
                                        .repeats_in_process = true, // each call has a process of its own
                                        .may_crash = false};

  /// Elements made per unit of the integral of h^-3.
  static constexpr double elements_per_inverse_cubed_size = 11.4;
  /// What Gmsh is told over the size wanted, for a mean edge of h on uniform fields.
  static constexpr double calibration = 0.68;

  /// Larger pieces than for other meshers, since each costs a process that loads Gmsh anew.
  static constexpr double elements_per_subdomain() { return 75000; }

  /// Gmsh's `Mesh.OptimizeThreshold`, 0 (no optimisation) to 0.55. At Gmsh's own 0.35, pieces with bad
  /// boundary triangles take twenty times as long; an improver that follows needs no more than this.
  double optimise_threshold = 0.1;
  double size_scale = 1.0;     ///< multiplies the field
  double limit_seconds = 3600; ///< the child's wall clock; the last resort

  /// Meshes the inside of `input.boundary`. Throws `mesher_error` when Gmsh fails or its result fails the
  /// checks; `sizing_error` when the field gives an unusable size.
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    detail::gmsh_settings settings;
    settings.name = "HXT";
    settings.algorithm = 10;
    settings.size_factor = calibration * size_scale;
    settings.optimise_threshold = optimise_threshold;
    settings.limit_seconds = limit_seconds;
    return detail::mesh_with_gmsh(settings, input, size);
  }
};

static_assert(boundary_keeping_mesher<gmsh_hxt, 3>);

} // namespace dovetail::mesher
