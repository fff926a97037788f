/// @file
/// Improves the pieces of a finished mesh once more, each inside its boundary: after redistribution by
/// elements, what was at an interface when it was meshed is inside now (paper, section 4).
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <functional>
#include <vector>

namespace dovetail {

/// What is counted of improving pieces.
struct improvement_counts {
  std::size_t pieces = 0;      ///< that were improved
  global_id elements = 0;      ///< of these, before
  double improver_seconds = 0; ///< summed over the pieces

  using fields = field_list<&improvement_counts::pieces, &improvement_counts::elements,
                            &improvement_counts::improver_seconds>;
};

/// A mesh whose pieces were improved.
struct improved_pieces {
  distributed_mesh mesh;              ///< with the improved pieces
  quality_statistics quality;         ///< of all of it
  report summary;                     ///< `improvement_counts`
  std::vector<local_id> piece_before; ///< per piece: which it was; there may be fewer now
};

/// The pieces' qualities together; each of them has been measured.
quality_statistics quality_of_whole(const distributed_mesh& mesh);

/// How pieces are improved.
struct improving_options {
  progress on_progress = {};       ///< told how the pieces come along
  std::vector<local_id> only = {}; ///< the pieces to improve, growing; none: all
};

/// A task per piece, without any communication between them: points and sides of the skeleton stay, so the
/// result conforms, which each task checks. It is the same for any executor. Memory: a piece per worker, and
/// all of them unless the executor keeps its results on a disk.
///
/// Throws `mesh_error` that names the piece when the improver fails or changes what it may not, `usage_error`
/// for a mesh of second order or an improver that may not run in the executor's threads, `io_error` and
/// `sizing_error`, and `cancelled`.
/// Complexity: that of the improver, once per piece.
/// \param mesh what `generate` makes, or a redistribution
/// \param improve improves a piece inside its boundary
/// \param size edge lengths wanted, in the units of the model
/// \param run_tasks carries out independent tasks; the result does not depend on it
/// \param options progress, and which pieces
improved_pieces improve_pieces(const distributed_mesh& mesh, const any_improver<3>& improve,
                               const any_sizing& size, const any_executor& run_tasks,
                               const improving_options& options = {});

/// What `improve_pieces` does, with these parameters, or something in its place.
using improving_strategy =
    std::function<improved_pieces(const distributed_mesh&, const any_improver<3>&, const any_sizing&,
                                  const any_executor&, const improving_options&)>;

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/distributed/improve_pieces.ipp"
#endif
