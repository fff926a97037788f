/// @file
/// The improver of Loehner as section 5.3 of the paper describes it (its reference [2]).
#pragma once

#include "dovetail/distributed/improve_pieces.hpp"

namespace dovetail::baselines {

/// Improves a distributed mesh in the steps of the paper:
///
/// 1. The mesh comes in pieces that are even already (`redistribution_by::elements`).
/// 2. The pieces are improved in parallel, their interfaces fixed.
/// 3. To each piece i two layers of elements are added from each neighbour j for which i < j: of j's elements
///    first those with a vertex of i, then those that share a vertex with the first. What several pieces
///    could have goes to the least of them.
/// 4. The new pieces are improved in parallel, their interfaces fixed.
///
/// A piece of which all elements lie within two layers of lesser ones ends there. Nothing passes a material
/// face.
///
/// The result is the same for any executor. Time: pieces of low numbers grow, and the largest of them decides
/// how long step 4 takes. Errors are those of `improve_pieces`.
///
/// The summary is that of `improve_pieces` over both passes, with children "first pass", "redistribution"
/// (its counters: "elements", those that moved, "pieces", "largest_over_mean" of their elements) and "second
/// pass".
struct loehner_improvement {
  int layers = 2; ///< of elements that a piece gets from each neighbour

  /// Improves `mesh`; `size` is the sizing field of its elements.
  improved_pieces operator()(const distributed_mesh& mesh, const any_improver<3>& improve,
                             const any_sizing& size, const any_executor& run_tasks,
                             const improving_options& options = {}) const;
};

} // namespace dovetail::baselines

#ifndef DOVETAIL_COMPILED
#include "dovetail/experiments/baselines/loehner_improvement.ipp"
#include "dovetail/improver/any_improver.hpp"
#endif
