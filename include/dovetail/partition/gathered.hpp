/// @file
/// Any partitioner on a graph whose rows are spread over ranks.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/graph/distributed_csr_graph.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/distributed_concepts.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail {

/// The whole graph on rank 0, an empty one on the others. Collective. Linear in the whole graph.
csr_graph gather_rows(any_communicator& network, const distributed_csr_graph& graph);

namespace detail {

/// A rank's own of what `work()` returns on rank 0: a value per node of the whole graph. Collective.
template <class Work>
std::vector<local_id> own_share(any_communicator& network, const distributed_csr_graph& graph,
                                const Work& work) {
  const std::vector<local_id> all = network.once([&] { return std::vector<local_id>(work()); });
  if (all.size() != static_cast<std::size_t>(graph.node_count()))
    throw partition_error("the partitioner put " + std::to_string(all.size()) +
                          " nodes into parts, the graph has " + std::to_string(graph.node_count()));
  return {all.begin() + graph.first(), all.begin() + graph.end()};
}

} // namespace detail

namespace partition {

/// Gathers the graph on rank 0, which partitions it alone: the parts are the same for any number of ranks. Of
/// redistribution by elements, a graph of 2 million nodes for a billion elements.
template <graph_partitioner P>
struct gathered {
  P partitioner; ///< what partitions on rank 0

  static constexpr bool depends_on_ranks() { return false; }
  std::vector<local_id> operator()(any_communicator& network, const distributed_csr_graph& graph,
                                   int parts) const {
    const csr_graph whole = gather_rows(network, graph);
    return detail::own_share(network, graph, [&] { return partitioner(whole, parts); });
  }
};
template <class P>
gathered(P) -> gathered<P>;

} // namespace partition
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/gathered.ipp"
#endif
