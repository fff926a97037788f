/// @file
/// The parameters of the native improver. Who calls it includes native.hpp.
#pragma once

#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/surface_host.hpp"

namespace dovetail::improvement {

/// What is raised (see shape_measure.hpp): `minimum_dihedral`, `radius_ratio` or `mean_ratio`.
enum class objective { minimum_dihedral, radius_ratio, mean_ratio };

/// Improves a mesh of tetrahedra or triangles by flips and moves of free vertices, worst elements first to be
/// dealt with and good ones left alone. Models `improver<native, 3>` and, in the plane or on a surface,
/// `improver<native, 2>`. Start from a preset: `native::fast()`,
/// `native::fine()` (the same as `native{}`), `native::finest()`, `native::hard()` for small coarse meshes.
struct native {
  static constexpr improver_traits traits{.thread_safe = true};

  /// Elements with a dihedral angle under this, in degrees, are worked on.
  double target_angle = 29;
  /// Elements that are still under this are tried again with larger cavities.
  double stubborn_angle = 25;
  /// Tetrahedra that are still under this are tried once more, with edges down to a quarter of
  /// `shortest_edge`: mostly those beside details much smaller than the size. 0: none.
  double bad_angle = 15;
  /// Sweeps over the poor elements at most.
  int passes = 12;
  /// Sweeps over what is then still poor, in which vertices are inserted and removed as well.
  int hard_passes = 8;
  /// Sweeps at the end over all free vertices of tetrahedra, for the mean of the elements; 0: none. See
  /// global_smoothing.hpp.
  int global_passes = 0;
  /// Two sweeps in a row that mend a smaller part of what the poor elements lack are the last ones.
  double least_gain = 0.01;
  /// Edges that an operation makes stay between these two, times the size there, or between the shortest and
  /// longest edge that were there before. Without a sizing field the size is the mean length of the edges
  /// before.
  double shortest_edge = 0.4, longest_edge = 2;
  /// Linearisations per move of a vertex.
  int search_iterations = 6;
  improvement::objective objective = improvement::objective::minimum_dihedral;
  /// Count elements by class before and after, for the report. Costs about 5 % of preset `fast`.
  bool statistics = true;

  static native fast();
  /// The preset for meshes that are to be good; `finest` and `hard` take longer.
  static native fine() { return {}; }
  /// The preset for as good as it gets.
  static native finest();
  /// The preset for small coarse meshes, to be raised whatever it costs.
  static native hard();

  /// Complexity: O(elements) once, then O(poor elements). Throws `mesh_error` when the input is not a mesh.
  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen = {},
                    const any_sizing& size = {}) const;
  /// Triangles stay on `host`: see triangles/triangle_improver.hpp. The smallest angle is the objective
  /// whatever `objective` says.
  report operator()(simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen = {},
                    const any_sizing& size = {}, const surface_host& host = {}) const;
};

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/native_parameters.ipp"
#endif
