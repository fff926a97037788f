/// @file
/// Adapter: the interface of ParMETIS, of which PT-Scotch has an implementation too, as a distributed graph
/// partitioner.
#pragma once

#include "dovetail/adapters/mpi_world.hpp"
#include "dovetail/partition/distributed_concepts.hpp"
#include "dovetail/partition/distributed_multilevel.hpp"
#include "dovetail/partition/integer_weights.hpp"

#include <metis.h> // ParMETIS's types; PT-Scotch's header would say METIS's error codes once more
#ifndef SCOTCH_METIS_RETURN
#define SCOTCH_METIS_RETURN
#endif
#include <parmetis.h>
#ifdef SCOTCH_PARMETIS_VERSION
#include <ptscotch.h>
#endif

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

namespace dovetail::partition {

/// Multilevel k-way partitioning by `ParMETIS_V3_PartKway` on all ranks, none of which has the whole graph,
/// then, where it missed the limit or left a part empty, a repair by single moves on rank 0. Graphs that
/// multilevel methods are not made for go to `greedy`. Other numbers of ranks give other parts.
struct parmetis {
  double imbalance = 1.03;         ///< heaviest part over average part
  int seed = 1;                    ///< other seeds give other parts
  MPI_Comm world = MPI_COMM_WORLD; ///< of the ranks of the network, which is `parallel::mpi`

  static constexpr bool depends_on_ranks() { return true; }

  /// Throws, on all ranks, `usage_error` when the ranks of the network are not those of `world`, and
  /// `partition_error` when there are fewer nodes than parts, when the graph exceeds METIS's integers, or
  /// when ParMETIS fails. PT-Scotch's implementation gives what threads happen to find, unless
  /// SCOTCH_PTHREAD_NUMBER is 1 in the environment: anything else is a `usage_error` too.
  std::vector<local_id> operator()(any_communicator& network, const distributed_csr_graph& graph,
                                   int parts) const {
    detail::require_ranks_of_mpi(network, world, "ParMETIS");
    detail::agreed(network, require_repeatable);
    return detail::partition_distributed(
        network, graph, parts, imbalance, seed,
        [&](const detail::graph_sums& sums) { return call(network, graph, sums, parts); });
  }

private:
  static void require_repeatable() {
#ifdef SCOTCH_PARMETIS_VERSION
    const char* threads = std::getenv("SCOTCH_PTHREAD_NUMBER");
    if (threads == nullptr || std::string(threads) != "1")
      throw usage_error(
          "PT-Scotch's ParMETIS gives the same parts again only with SCOTCH_PTHREAD_NUMBER=1 in "
          "the environment; set it, or use ptscotch");
#endif
  }
  std::vector<local_id> call(any_communicator& network, const distributed_csr_graph& graph,
                             const detail::graph_sums& sums, int parts) const {
    const csr_graph& rows = graph.rows;
    std::vector<idx_t> node_weights, edge_weights;
    detail::agreed(network, [&] {
      node_weights = detail::integer_weights<idx_t>(rows.node_weights, sums.nodes, "ParMETIS", "nodes");
      edge_weights = detail::integer_weights<idx_t>(rows.edge_weights, sums.edges, "ParMETIS", "edges");
    });
    std::vector<idx_t> first_of_rank(graph.first_of_rank.begin(), graph.first_of_rank.end());
    std::vector<idx_t> offsets(rows.offsets.begin(), rows.offsets.end());
    std::vector<idx_t> neighbours(rows.neighbours.begin(), rows.neighbours.end());
    std::vector<real_t> shares(static_cast<std::size_t>(parts), real_t{1} / static_cast<real_t>(parts));
    auto most = static_cast<real_t>(imbalance);
    std::array<idx_t, 3> options{1, 0, seed};
    idx_t both_weights = 3, numbers_from = 0, constraints = 1, wanted = parts, cut = 0;
    std::vector<idx_t> part(rows.node_weights.size());
    detail::agreed(network, [&] {
#ifdef SCOTCH_PARMETIS_VERSION // which goes on with the random numbers of the call before
      SCOTCH_randomSeed(seed);
      SCOTCH_randomReset();
#endif
      MPI_Comm over = world;
      const int status =
          ParMETIS_V3_PartKway(first_of_rank.data(), offsets.data(), neighbours.data(), node_weights.data(),
                               edge_weights.data(), &both_weights, &numbers_from, &constraints, &wanted,
                               shares.data(), &most, options.data(), &cut, part.data(), &over);
      if (status != METIS_OK)
        throw partition_error("ParMETIS failed with status " + std::to_string(status) + " on a graph of " +
                              std::to_string(graph.node_count()) + " nodes and " + std::to_string(parts) +
                              " parts");
    });
    return {part.begin(), part.end()};
  }
};

static_assert(distributed_graph_partitioner<parmetis>);

} // namespace dovetail::partition
