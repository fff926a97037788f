/// @file
/// What is asked of a redistributor: the step between meshing and the solver.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <concepts>
#include <vector>

namespace dovetail {

/// Which rank holds which piece.
struct redistribution {
  std::vector<local_id> rank_of_piece;
  report summary; ///< as `describe_redistribution` makes it
};

/// The role `redistributor<R, D>`: give the pieces of a mesh to the ranks of a solver. D = 3 when it is not
/// said.
///
/// Valid expression for `const R& r`, `const distributed_simplicial_mesh<D>& mesh`, `int ranks`:
/// `r(mesh, ranks)` -> redistribution, with the rank in [0, ranks) of every piece.
///
/// Semantics: goes by the counts and the skeleton, loads no piece. Every rank has a piece when there are at
/// least as many pieces as ranks. A pure function, so that every rank may call it by itself.
///
/// Complexity: linear in the skeleton, and that of a graph partitioner in the pieces.
///
/// Failure: throws `partition_error`, also when there are more ranks than pieces. Whoever holds one in an
/// `any_redistributor` gets that too for ranks out of range, without a piece, or for another number of
/// pieces.
///
/// Models: redistribution_by::pieces, redistribution_by::blocks.
template <class R, int D = 3>
concept redistributor = std::copy_constructible<R> &&
    requires(const R& r, const distributed_simplicial_mesh<D>& mesh, int ranks) {
  { r(mesh, ranks) } -> std::same_as<redistribution>;
};

} // namespace dovetail
