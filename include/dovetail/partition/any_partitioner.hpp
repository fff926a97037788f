/// @file
/// Any graph partitioner behind one type, so that the pipeline is compiled once and not once per partitioner.
#pragma once

#include "dovetail/partition/concepts.hpp"

#include <concepts>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Holds any graph partitioner by value; a partitioner converts to it. A call costs one indirect call, and a
/// look at the graph and at the result (`checked_partition`), which names the partitioner in its errors.
class any_partitioner {
public:
  template <class P>
    requires(!std::same_as<P, any_partitioner> && graph_partitioner<P>)
  any_partitioner(P policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)), call_(std::move(policy)) {}

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const;

private:
  std::string name_;
  std::function<std::vector<local_id>(const csr_graph&, int)> call_;
};
static_assert(graph_partitioner<any_partitioner>);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/any_partitioner.ipp"
#endif
