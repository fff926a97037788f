/// @file
/// dovetail's own mesher of pieces: points first, all of them into one Delaunay tetrahedrization, then the
/// boundary by local changes.
#pragma once

#include "dovetail/mesher/concepts.hpp"

namespace dovetail::mesher {

/// What is counted of a recovery, beside `mesher_counts`.
struct native_counts {
  std::size_t missing_edges = 0;           ///< of the boundary, in the Delaunay tetrahedrization
  std::size_t missing_triangles = 0;       ///< once the edges were there
  std::size_t recovery_splits = 0;         ///< edges and triangles divided for a while
  std::size_t recovery_points = 0;         ///< points more that are left
  std::size_t recovery_points_removed = 0; ///< that are in no element again
  std::size_t recovery_operations = 0;     ///< elements visited and places compared

  using fields = field_list<&native_counts::missing_edges, &native_counts::missing_triangles,
                            &native_counts::recovery_splits, &native_counts::recovery_points,
                            &native_counts::recovery_points_removed, &native_counts::recovery_operations>;
};

/// A model of `boundary_keeping_mesher<3>` that needs no library and runs in threads.
///
/// Points of a lattice graded by the sizes are inserted together with those of the boundary; what the
/// Delaunay tetrahedrization lacks of the boundary is recovered by flips and a few points more. Elements are
/// not improved: slivers are left to the improver.
struct native {
  static constexpr mesher_traits traits{
      .keeps_boundary = true, .thread_safe = true, .accepts_non_manifold = true, .repeats_in_process = true};
  /// Elements made per unit of the integral of h^-3.
  static constexpr double elements_per_inverse_cubed_size = 9.8;

  double size_scale = 1.0; ///< multiplies the field, and what it says of its least sizes

  /// Meshes the inside of `input.boundary`. Throws `mesher_error` when a part of the boundary could not be
  /// recovered, which it names; `sizing_error` when the field gives an unusable size. The pipeline checks the
  /// result; who calls this alone can do so by `check_mesher_result`.
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const;
};

static_assert(boundary_keeping_mesher<native, 3>);

} // namespace dovetail::mesher

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/native.ipp"
#endif
