/// @file
/// CGAL's tetrahedral isotropic remeshing, its boundary kept, as an improver.
#pragma once

#include "dovetail/improver/concepts.hpp"

namespace dovetail {

namespace improvement {

/// CGAL's remesher: splits, collapses, flips and smoothing towards edges of the target length. Models
/// `improver<cgal, 3>`. Without a sizing field the target is the mean edge length of each material: a
/// strongly graded mesh then loses its grading. Inner frozen sides are not known to it: a result that lost
/// one is not used (see `improve_by_library`). Where CGAL's assertions are on (without NDEBUG) it refuses
/// meshes whose boundary is not a sphere; they are then left as they were. Runs in a forked child, for it may
/// crash: the calling process must have one thread only (`usage_error` otherwise).
struct cgal {
  static constexpr improver_traits traits{.thread_safe = false};

  int iterations = 3;          ///< rounds of remeshing
  double limit_seconds = 3600; ///< the child's wall clock; the last resort

  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen = {},
                    const any_sizing& size = {}) const;
};

} // namespace improvement

static_assert(improver<improvement::cgal, 3>);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED_CGAL
#include "dovetail/adapters/cgal_improver.ipp"
#endif
