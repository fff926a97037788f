/// @file
/// From a distributed mesh to what one rank holds of it.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/rank_mesh.hpp"
#include "dovetail/solver/rank_numbering.hpp"

#include <cstdint>

namespace dovetail::io {

/// The mesh of one rank, of second order where the distributed mesh has `mid_nodes`. Vertices that the rank
/// owns are in the order of their ids (rank_numbering.hpp); elements piece by piece. Loads the rank's own
/// pieces, once; for ghosts also each piece of another rank that touches one of its points, whole, one in
/// memory at a time, since who touches what is known of pieces only (with 20 pieces per rank about as many
/// again). Pure; linear in what it loads and the skeleton, of which it reads all. Memory: the result, 8 bytes
/// per node of the skeleton, and one piece.
///
/// Throws `mesh_error` when pieces and skeleton disagree, when a point of the rank is in none of its
/// elements, or when it has more of them than local ids can number.
/// \param mesh the mesh that `numbers` are of
/// \param numbers from `number_by_ranks`
/// \param rank from 0
/// \param ghosts whether elements of other ranks that touch this one's are there too
template <int D>
rank_mesh<D> make_rank_mesh(const distributed_simplicial_mesh<D>& mesh, const rank_numbering& numbers,
                            local_id rank, bool ghosts = false);

/// How large the mesh of a rank is, ghosts with it.
struct rank_counts {
  std::uint64_t vertices = 0; ///< those that it holds, and those of ghosts
  std::uint64_t elements = 0; ///< its own, and ghosts
  std::uint64_t sides = 0;    ///< on CAD faces (D = 3) or curves (D = 2)
};

/// What counting in the result of `make_rank_mesh` would give. Loads no piece; for ghosts those that have
/// them.
template <int D>
rank_counts count_rank_mesh(const distributed_simplicial_mesh<D>& mesh, const rank_numbering& numbers,
                            local_id rank, bool ghosts = false);

/// A mesh numbered for ranks: what each of them needs to make its own.
template <int D>
struct rank_source {
  const distributed_simplicial_mesh<D>& mesh; ///< the whole mesh
  rank_numbering numbers;                     ///< who owns what
  bool ghosts = false; ///< whether ranks get elements of others that touch their vertices

  /// The mesh of one rank, or its counts alone (`counts_of`).
  rank_mesh<D> mesh_of(local_id rank) const { return make_rank_mesh<D>(mesh, numbers, rank, ghosts); }
  rank_counts counts_of(local_id rank) const { return count_rank_mesh<D>(mesh, numbers, rank, ghosts); }
};

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/make_rank_mesh.ipp"
#endif
