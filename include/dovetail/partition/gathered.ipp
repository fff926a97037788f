/// @file
/// What `gathered.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/distributed_csr_graph.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/partition/gathered.hpp"

#include <cstddef>
#include <cstdint>

namespace dovetail {

DOVETAIL_INLINE csr_graph gather_rows(any_communicator& network, const distributed_csr_graph& graph) {
  if (network.size() == 1)
    return graph.rows;
  csr_graph whole;
  for (const csr_graph& rows : network.gather(graph.rows)) {
    const std::int64_t edges_before = whole.offsets.back();
    for (std::size_t v = 1; v < rows.offsets.size(); ++v)
      whole.offsets.push_back(edges_before + rows.offsets[v]);
    append(whole.neighbours, rows.neighbours);
    append(whole.edge_weights, rows.edge_weights);
    append(whole.node_weights, rows.node_weights);
    append(whole.positions, rows.positions);
  }
  return whole;
}

} // namespace dovetail
