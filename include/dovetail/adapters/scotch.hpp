/// @file
/// Adapter: Scotch 7 as a graph partitioner.
#pragma once

#include "dovetail/adapters/scotch_objects.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/integer_weights.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <cstdint>
#include <vector>

namespace dovetail::partition {

/// Multilevel partitioning by Scotch, recursive bisection or k-way as Scotch sees fit, then, where it missed
/// the limit or left a part empty, a repair by single moves. Graphs that multilevel methods are not made for
/// go to `greedy`. Real weights are scaled to Scotch's integers. Runs in one thread with its own random
/// numbers, so calls do not disturb each other.
struct scotch {
  double imbalance = 1.03;                             ///< heaviest part over average part
  scotch_strategy strategy = scotch_strategy::quality; ///< what Scotch strives for
  int seed = 1;                                        ///< other seeds give other parts

  /// The part in [0, parts) of every node. Throws `partition_error` when there are fewer nodes than parts,
  /// when the graph exceeds Scotch's integers, or when Scotch fails.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    detail::require_partitionable(graph, parts);
    detail::require_imbalance(imbalance);
    if (parts == 1)
      return std::vector<local_id>(graph.node_weights.size(), 0);
    if (detail::is_too_small_for_multilevel(graph, parts))
      return greedy{.imbalance = imbalance, .seed = static_cast<std::uint64_t>(seed)}(graph, parts);
    std::vector<local_id> part = call(graph, parts);
    detail::finish_partition(graph, part, parts, imbalance, 0);
    return part;
  }

private:
  std::vector<local_id> call(const csr_graph& graph, int parts) const {
    const auto node_weights = detail::integer_weights<SCOTCH_Num>(graph.node_weights, "Scotch", "nodes");
    const auto edge_weights = detail::integer_weights<SCOTCH_Num>(graph.edge_weights, "Scotch", "edges");
    const std::vector<SCOTCH_Num> offsets(graph.offsets.begin(), graph.offsets.end());
    const std::vector<SCOTCH_Num> neighbours(graph.neighbours.begin(), graph.neighbours.end());

    detail::scotch_context context(seed);
    using graph_object = detail::scotch_object<SCOTCH_Graph, SCOTCH_graphExit>;
    graph_object plain(SCOTCH_graphInit, "make a graph");
    detail::require_scotch(SCOTCH_graphBuild(&plain.object, 0, graph.node_count(), offsets.data(),
                                             offsets.data() + 1, node_weights.data(), nullptr,
                                             static_cast<SCOTCH_Num>(neighbours.size()), neighbours.data(),
                                             edge_weights.data()),
                           "take the graph");
    graph_object bound(SCOTCH_graphInit, "make a graph");
    detail::require_scotch(SCOTCH_contextBindGraph(&context.object, &plain.object, &bound.object),
                           "bind the graph");
    detail::scotch_strategy_object how(SCOTCH_stratInit, "make a strategy");
    detail::require_scotch(
        SCOTCH_stratGraphMapBuild(&how.object, detail::flag_of(strategy), parts, imbalance - 1),
        "take the strategy");
    std::vector<SCOTCH_Num> part(graph.node_weights.size());
    detail::require_scotch(SCOTCH_graphPart(&bound.object, parts, &how.object, part.data()),
                           "partition the graph");
    return {part.begin(), part.end()};
  }
};

static_assert(graph_partitioner<scotch>);

} // namespace dovetail::partition
