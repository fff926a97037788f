/// @file
/// What is asked of a redistributor: the step between meshing and the solver.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <concepts>
#include <memory>
#include <vector>

namespace dovetail {

/// Which rank holds which piece.
template <int D>
struct redistribution {
  std::vector<local_id> rank_of_piece; ///< a rank for each piece
  report summary;                      ///< as `describe_redistribution` makes it
  /// The same elements in other pieces, to which the ranks belong; empty: the pieces are those of the mesh.
  std::shared_ptr<const distributed_simplicial_mesh<D>> mesh = {};

  /// The mesh whose pieces the ranks are of; `given` is what was redistributed.
  const distributed_simplicial_mesh<D>& divided(const distributed_simplicial_mesh<D>& given) const {
    return mesh ? *mesh : given;
  }
};

/// The role `redistributor<R, D>`: give the pieces of a mesh to the ranks of a solver. D = 3 when it is not
/// said.
///
/// Valid expression for `const R& r`, `const distributed_simplicial_mesh<D>& mesh`, `int ranks`:
/// `r(mesh, ranks)` -> redistribution<D>, with the rank in [0, ranks) of every piece.
///
/// Semantics: every rank has a piece when there are at least as many pieces as ranks. The result is a pure
/// function of the mesh, so that every rank may call it. Other pieces, if it makes them, have the same
/// elements.
///
/// Complexity: linear in the skeleton, and that of a graph partitioner in the pieces; to make other pieces it
/// loads each a few times.
///
/// Failure: throws `partition_error`, also when there are more ranks than pieces. `any_redistributor` throws
/// it also for ranks out of range, without a piece, or for another number of pieces.
///
/// Models: redistribution_by::pieces, redistribution_by::blocks, redistribution_by::elements.
template <class R, int D = 3>
concept redistributor = std::copy_constructible<R> &&
    requires(const R& r, const distributed_simplicial_mesh<D>& mesh, int ranks) {
  { r(mesh, ranks) } -> std::same_as<redistribution<D>>;
};

} // namespace dovetail
