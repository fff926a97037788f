/// @file
/// A partitioner around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/partition/concepts.hpp"

#include <vector>

namespace dovetail::partition {

/// Base of a partitioner that changes what another one is given or gives, or measures it.
template <class Self, class Partitioner>
struct wraps : wrapped_policy<Self, Partitioner> {
  static_assert(graph_partitioner<Partitioner>,
                "partition::wraps holds a graph_partitioner (partition/concepts.hpp)");
  using wrapped_policy<Self, Partitioner>::wrapped_policy;
  using wrapped_policy<Self, Partitioner>::wrapped;

  /// The parts that the wrapped partitioner makes.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const { return wrapped(graph, parts); }
};

} // namespace dovetail::partition
