/// @file
/// Any distributed graph partitioner behind one type.
#pragma once

#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/distributed_concepts.hpp"
#include "dovetail/partition/gathered.hpp"

#include <concepts>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Holds any distributed partitioner by value, or any other one in `gathered`; each converts to it. Throws
/// `partition_error` that names the partitioner for a result with other than a part in [0, parts) for every
/// node, or with an empty part where there are nodes enough.
class any_distributed_partitioner {
public:
  template <class P>
    requires(!std::same_as<P, any_distributed_partitioner> &&
             (distributed_graph_partitioner<P> || graph_partitioner<P>))
  any_distributed_partitioner(P policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)) {
    if constexpr (distributed_graph_partitioner<P>) {
      depends_on_ranks_ = policy.depends_on_ranks();
      call_ = std::move(policy);
    } else {
      of_whole_ = policy;
      call_ = partition::gathered<P>{std::move(policy)};
    }
  }

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  bool depends_on_ranks() const { return depends_on_ranks_; }

  std::vector<local_id> operator()(any_communicator& network, const distributed_csr_graph& graph,
                                   int parts) const {
    const auto all = parts_of_all(network, graph, parts);
    return {all.begin() + graph.first(), all.begin() + graph.end()};
  }

  /// Of a graph that all ranks have: the part of every node, on all ranks. Collective. Who would have to
  /// gather it on rank 0 takes what is there.
  std::vector<local_id> of_whole(any_communicator& network, const csr_graph& graph, int parts) const;

private:
  std::vector<local_id> parts_of_all(any_communicator& network, const distributed_csr_graph& graph,
                                     int parts) const;

  std::string name_;
  bool depends_on_ranks_ = false;
  std::function<std::vector<local_id>(any_communicator&, const distributed_csr_graph&, int)> call_;
  std::function<std::vector<local_id>(const csr_graph&, int)>
      of_whole_; ///< none where rows need not be gathered
};
static_assert(distributed_graph_partitioner<any_distributed_partitioner>);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/any_distributed_partitioner.ipp"
#endif
