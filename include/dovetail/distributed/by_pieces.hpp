/// @file
/// Redistributors that give whole pieces to ranks: nothing is cut, no element migrates.
#pragma once

#include "dovetail/distributed/piece_graph.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/greedy.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

/// Evens out the weights of parts with few nodes: joins what is not connected to its neighbours, then moves
/// single nodes, or exchanges two of neighbouring parts, as long as no part is more in pieces for it, in the
/// order of what that evens out most. Each step lowers the sum of the squares of the weights, so this ends.
/// Stops when no part exceeds `imbalance` times the average. About a part's nodes squared, times its edges,
/// per step.
void even_out_connected(const csr_graph& graph, std::vector<local_id>& part, int parts, double imbalance);

namespace redistribution_by {

/// Partitions the graph of pieces, then evens it out. With about 20 pieces per rank, ranks are within 5 % of
/// the average, and connected where the partitioner leaves them connected or it can be mended.
struct pieces {
  any_partitioner partitioner = partition::greedy{}; ///< of the graph of pieces
  double imbalance = 1.02;                           ///< largest over average rank that is tried for

  template <int D>
  redistribution<D> operator()(const distributed_simplicial_mesh<D>& mesh, int ranks) const {
    require_pieces_for(mesh.counts.size(), ranks);
    const csr_graph graph = piece_graph(mesh);
    std::vector<local_id> rank = partitioner(graph, ranks);
    even_out_connected(graph, rank, ranks, imbalance);
    report summary = describe_redistribution(graph, rank, ranks);
    return {std::move(rank), std::move(summary), {}};
  }
};
static_assert(redistributor<pieces, 2> && redistributor<pieces, 3>);

/// Pieces in blocks of their numbers, about equally many for each rank, wherever they are: what workers who
/// made the pieces in turn have already.
struct blocks {
  template <int D>
  redistribution<D> operator()(const distributed_simplicial_mesh<D>& mesh, int ranks) const {
    require_pieces_for(mesh.counts.size(), ranks);
    const auto count = static_cast<global_id>(mesh.counts.size());
    std::vector<local_id> rank;
    for (global_id p = 0; p < count; ++p)
      rank.push_back(static_cast<local_id>(p * ranks / count));
    report summary = describe_redistribution(piece_graph(mesh), rank, ranks);
    return {std::move(rank), std::move(summary), {}};
  }
};
static_assert(redistributor<blocks, 2> && redistributor<blocks, 3>);

} // namespace redistribution_by
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/distributed/by_pieces.ipp"
#endif
