/// @file
/// Adapter: PT-Scotch 7 as a distributed graph partitioner.
#pragma once

#include "dovetail/adapters/mpi_world.hpp"
#include "dovetail/adapters/scotch_objects.hpp"
#include "dovetail/partition/distributed_concepts.hpp"
#include "dovetail/partition/distributed_multilevel.hpp"
#include "dovetail/partition/integer_weights.hpp"

#include <mpi.h>
#include <ptscotch.h>

#include <vector>

namespace dovetail::partition {

/// Multilevel partitioning by PT-Scotch on all ranks, none of which has the whole graph, then, where it
/// missed the limit or left a part empty, a repair by single moves on rank 0. Graphs that multilevel methods
/// are not made for go to `greedy`. One thread per rank. Other numbers of ranks give other parts.
///
/// The library has the functions of Scotch in it: a program that links both links PT-Scotch first.
struct ptscotch {
  double imbalance = 1.03;                             ///< heaviest part over average part
  scotch_strategy strategy = scotch_strategy::quality; ///< what PT-Scotch strives for
  int seed = 1;                                        ///< other seeds give other parts
  MPI_Comm world = MPI_COMM_WORLD; ///< of the ranks of the network, which is `parallel::mpi`

  static constexpr bool depends_on_ranks() { return true; }

  /// Throws, on all ranks, `usage_error` when the ranks of the network are not those of `world`, and
  /// `partition_error` when there are fewer nodes than parts, when the graph exceeds PT-Scotch's integers, or
  /// when it fails.
  std::vector<local_id> operator()(any_communicator& network, const distributed_csr_graph& graph,
                                   int parts) const {
    detail::require_ranks_of_mpi(network, world, "PT-Scotch");
    return detail::partition_distributed(
        network, graph, parts, imbalance, seed,
        [&](const detail::graph_sums& sums) { return call(network, graph.rows, sums, parts); });
  }

private:
  std::vector<local_id> call(any_communicator& network, const csr_graph& rows, const detail::graph_sums& sums,
                             int parts) const {
    std::vector<SCOTCH_Num> offsets, neighbours, node_weights, edge_weights;
    detail::agreed(network, [&] {
      node_weights = detail::integer_weights<SCOTCH_Num>(rows.node_weights, sums.nodes, "PT-Scotch", "nodes");
      edge_weights = detail::integer_weights<SCOTCH_Num>(rows.edge_weights, sums.edges, "PT-Scotch", "edges");
    });
    offsets.assign(rows.offsets.begin(), rows.offsets.end());
    neighbours.assign(rows.neighbours.begin(), rows.neighbours.end());
    const auto nodes = static_cast<SCOTCH_Num>(rows.node_weights.size());
    const auto edges = static_cast<SCOTCH_Num>(neighbours.size());
    std::vector<SCOTCH_Num> part(rows.node_weights.size());
    detail::agreed(network, [&] {
      detail::scotch_context context(seed);
      using graph_object = detail::scotch_object<SCOTCH_Dgraph, SCOTCH_dgraphExit>;
      const auto init = [&](SCOTCH_Dgraph* made) { return SCOTCH_dgraphInit(made, world); };
      graph_object plain(init, "make a distributed graph");
      detail::require_scotch(SCOTCH_dgraphBuild(&plain.object, 0, nodes, nodes, offsets.data(),
                                                offsets.data() + 1, node_weights.data(), nullptr, edges,
                                                edges, neighbours.data(), nullptr, edge_weights.data()),
                             "take the distributed graph");
      graph_object bound(init, "make a distributed graph");
      detail::require_scotch(SCOTCH_contextBindDgraph(&context.object, &plain.object, &bound.object),
                             "bind the distributed graph");
      detail::scotch_strategy_object how(SCOTCH_stratInit, "make a strategy");
      detail::require_scotch(SCOTCH_stratDgraphMapBuild(&how.object, detail::flag_of(strategy),
                                                        network.size(), parts, imbalance - 1),
                             "take the strategy");
      detail::require_scotch(SCOTCH_dgraphPart(&bound.object, parts, &how.object, part.data()),
                             "partition the distributed graph");
    });
    return {part.begin(), part.end()};
  }
};

static_assert(distributed_graph_partitioner<ptscotch>);

} // namespace dovetail::partition
