/// @file
/// Adapter: Scotch 7 as a graph partitioner.
#pragma once

#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/integer_weights.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <cstdint> // scotch.h does not include what it needs
#include <cstdio>
#include <scotch.h>

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail::partition {

/// What Scotch is told to strive for.
enum class scotch_strategy { quality, speed, balance };

/// Multilevel partitioning by Scotch, recursive bisection or k-way as Scotch sees fit, then, where it missed
/// the limit or left a part empty, a repair by single moves. Graphs that multilevel methods are not made for
/// go to `greedy`. Real weights are scaled to Scotch's integers. Runs in one thread with its own random
/// numbers, so calls do not disturb each other.
struct scotch {
  double imbalance = 1.03; ///< heaviest part over average part
  scotch_strategy strategy = scotch_strategy::quality;
  int seed = 1;

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
  /// One of Scotch's objects, released when it goes out of scope. Its functions return 0 when all is well.
  template <class Object, void (*Exit)(Object*)>
  struct held {
    template <class Init>
    held(const Init& init, const char* what) {
      require(init(&object), what);
    }
    held(const held&) = delete;
    held& operator=(const held&) = delete;
    ~held() { Exit(&object); }
    Object object;
  };
  using held_context = held<SCOTCH_Context, SCOTCH_contextExit>;
  using held_graph = held<SCOTCH_Graph, SCOTCH_graphExit>;
  using held_strategy = held<SCOTCH_Strat, SCOTCH_stratExit>;

  static void require(int status, const char* what) {
    if (status != 0)
      throw partition_error(std::string("Scotch failed to ") + what + ", status " + std::to_string(status) +
                            "; use another partitioner");
  }

  SCOTCH_Num strategy_flag() const {
    switch (strategy) {
    case scotch_strategy::speed:
      return SCOTCH_STRATSPEED;
    case scotch_strategy::balance:
      return SCOTCH_STRATBALANCE;
    default:
      return SCOTCH_STRATQUALITY;
    }
  }

  void prepare(SCOTCH_Context* context) const {
    require(SCOTCH_contextOptionSetNum(context, SCOTCH_OPTIONNUMDETERMINISTIC, 1), "be deterministic");
    require(SCOTCH_contextThreadSpawn(context, 1, nullptr), "run in one thread");
    require(SCOTCH_contextRandomClone(context), "make random numbers");
    SCOTCH_contextRandomSeed(context, seed);
    SCOTCH_contextRandomReset(context);
  }

  std::vector<local_id> call(const csr_graph& graph, int parts) const {
    const auto node_weights = detail::integer_weights<SCOTCH_Num>(graph.node_weights, "Scotch", "nodes");
    const auto edge_weights = detail::integer_weights<SCOTCH_Num>(graph.edge_weights, "Scotch", "edges");
    const std::vector<SCOTCH_Num> offsets(graph.offsets.begin(), graph.offsets.end());
    const std::vector<SCOTCH_Num> neighbours(graph.neighbours.begin(), graph.neighbours.end());

    held_context context(SCOTCH_contextInit, "start");
    prepare(&context.object);
    held_graph plain(SCOTCH_graphInit, "make a graph");
    require(SCOTCH_graphBuild(&plain.object, 0, graph.node_count(), offsets.data(), offsets.data() + 1,
                              node_weights.data(), nullptr, static_cast<SCOTCH_Num>(neighbours.size()),
                              neighbours.data(), edge_weights.data()),
            "take the graph");
    held_graph bound(SCOTCH_graphInit, "make a graph");
    require(SCOTCH_contextBindGraph(&context.object, &plain.object, &bound.object), "bind the graph");
    held_strategy how(SCOTCH_stratInit, "make a strategy");
    require(SCOTCH_stratGraphMapBuild(&how.object, strategy_flag(), parts, imbalance - 1),
            "take the strategy");
    std::vector<SCOTCH_Num> part(graph.node_weights.size());
    require(SCOTCH_graphPart(&bound.object, parts, &how.object, part.data()), "partition the graph");
    return {part.begin(), part.end()};
  }
};

static_assert(graph_partitioner<scotch>);

} // namespace dovetail::partition
