/// @file
/// Adapter: METIS as a graph partitioner.
#pragma once

#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/integer_weights.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <metis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dovetail::partition {

/// METIS takes SIGTERM for an error of its own while it runs: it comes afterwards. And METIS leaves a handler
/// that was there good for one more signal only.
class held_signals {
public:
  held_signals() {
    sigset_t stops;
    ::sigemptyset(&stops);
    ::sigaddset(&stops, SIGTERM);
    ::sigaction(SIGTERM, nullptr, &handler_);
    ::pthread_sigmask(SIG_BLOCK, &stops, &before_);
  }
  held_signals(const held_signals&) = delete;
  held_signals& operator=(const held_signals&) = delete;
  ~held_signals() {
    ::sigaction(SIGTERM, &handler_, nullptr);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

private:
  struct sigaction handler_ {};
  sigset_t before_{};
};

/// Multilevel partitioning by METIS (k-way, or recursive bisection), then, where METIS missed the limit or
/// left a part empty, a repair by single moves. Graphs that METIS cannot handle
/// quietly (a node as heavy as a part, hardly more nodes than parts) go to `greedy`. Real weights are scaled
/// to METIS's 32-bit integers.
struct metis {
  double imbalance = 1.03; ///< heaviest part over average part
  bool recursive = false;  ///< recursive bisection instead of k-way
  int seed = 1;            ///< other seeds give other parts
  /// Partitions tried, of which the one with the smallest cut is taken. 0: four of graphs of up to 100,000
  /// nodes in up to 64 parts, and one of others, where four take four times as long for a cut that is hardly
  /// smaller.
  int trials = 0;

  /// The part in [0, parts) of every node. Throws `partition_error` when there are fewer nodes than parts,
  /// when the graph exceeds METIS's integers, or when METIS fails.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    detail::require_partitionable(graph, parts);
    detail::require_imbalance(imbalance);
    if (parts == 1)
      return std::vector<local_id>(graph.node_weights.size(), 0);
    if (detail::is_too_small_for_multilevel(graph, parts)) // METIS runs into empty parts and prints about it
      return greedy{.imbalance = imbalance, .seed = static_cast<std::uint64_t>(seed)}(graph, parts);
    std::vector<local_id> part = call(graph, parts);
    detail::finish_partition(graph, part, parts, imbalance, 0);
    return part;
  }

private:
  static int default_trials(local_id nodes, int parts) { return nodes > 100'000 || parts > 64 ? 1 : 4; }

  /// METIS can keep parts connected, but only when the graph is.
  static bool has_one_component(const csr_graph& graph) {
    const std::vector<local_id> one(graph.node_weights.size(), 0);
    return components_within(graph, one).count == 1;
  }

  std::vector<local_id> call(const csr_graph& graph, int parts) const {
    std::vector<idx_t> node_weights = detail::integer_weights<idx_t>(graph.node_weights, "METIS", "nodes");
    std::vector<idx_t> edge_weights = detail::integer_weights<idx_t>(graph.edge_weights, "METIS", "edges");
    std::vector<idx_t> offsets(graph.offsets.begin(), graph.offsets.end());
    std::vector<idx_t> neighbours(graph.neighbours.begin(), graph.neighbours.end());
    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = seed;
    options[METIS_OPTION_NUMBERING] = 0;
    options[METIS_OPTION_CONTIG] = has_one_component(graph) ? 1 : 0;
    options[METIS_OPTION_NCUTS] = trials > 0 ? trials : default_trials(graph.node_count(), parts);
    options[METIS_OPTION_UFACTOR] = std::max(1, static_cast<idx_t>(std::lround((imbalance - 1) * 1000)));
    idx_t n = graph.node_count();
    idx_t constraints = 1;
    idx_t wanted = parts;
    idx_t cut = 0;
    std::vector<idx_t> part(static_cast<std::size_t>(n));
    // The k-way method is not meant for few nodes per part.
    const bool bisect = recursive || n < 10 * parts;
    const held_signals held;
    const int status = (bisect ? METIS_PartGraphRecursive : METIS_PartGraphKway)(
        &n, &constraints, offsets.data(), neighbours.data(), node_weights.data(), nullptr,
        edge_weights.data(), &wanted, nullptr, nullptr, options.data(), &cut, part.data());
    if (status != METIS_OK)
      throw partition_error("METIS failed with status " + std::to_string(status) + " on a graph of " +
                            std::to_string(n) + " nodes and " + std::to_string(parts) + " parts");
    return {part.begin(), part.end()};
  }
};

static_assert(graph_partitioner<metis>);

} // namespace dovetail::partition
