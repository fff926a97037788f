/// @file
/// The improver of Ito et al. as section 5.3 of the paper describes it (its reference [18]).
#pragma once

#include "dovetail/distributed/improve_pieces.hpp"

namespace dovetail::baselines {

/// Improves a distributed mesh in the steps of the paper:
///
/// 1. The mesh comes in pieces that are even already (`redistribution_by::elements`).
/// 2. The pieces are improved in parallel, their interfaces fixed.
/// 3. Two layers of elements beside the interfaces are collected into a single mesh. The first are those with
///    a vertex on an interface, the second those that share a vertex with the first.
/// 4. This mesh is improved sequentially, its boundary fixed.
///
/// Then its elements go back: each to the piece that it is nearest to, counted over sides. That makes new
/// interfaces, somewhere within the layers. A piece that had elements within the layers alone may end there.
/// In a model of several materials there is a mesh per material, since material faces stay.
///
/// The result is the same for any executor. Time: step 4 is done by one worker, whatever their number; its
/// mesh grows with the number of pieces. Errors are those of `improve_pieces`.
///
/// The summary is that of `improve_pieces` over both passes, with children "first pass", "collection" (its
/// counter "elements": those collected), "second pass" and "writing back".
struct ito_improvement {
  int layers = 2; ///< of elements beside the interfaces

  /// Improves `mesh`; `size` is the sizing field of its elements.
  improved_pieces operator()(const distributed_mesh& mesh, const any_improver<3>& improve,
                             const any_sizing& size, const any_executor& run_tasks,
                             const improving_options& options = {}) const;
};

} // namespace dovetail::baselines

#ifndef DOVETAIL_COMPILED
#include "dovetail/experiments/baselines/ito_improvement.ipp"
#include "dovetail/improver/any_improver.hpp"
#endif
