/// @file
/// What redistribution by elements asks of a partitioner of a graph that no rank need have as a whole.
#pragma once

#include "dovetail/graph/distributed_csr_graph.hpp"
#include "dovetail/parallel/any_communicator.hpp"

#include <concepts>
#include <vector>

namespace dovetail {

/// The role `distributed_graph_partitioner`: partition a weighted graph whose rows are spread over the ranks
/// of a communicator.
///
/// Valid expressions for `const P& p`, `any_communicator& network`, `const distributed_csr_graph& g`,
/// `int parts`:
///
/// - `p(network, g, parts)`: std::vector<local_id>, the part in [0, parts) of each node of this rank
/// - `p.depends_on_ranks()`: whether another number of ranks may give other parts
///
/// Semantics: collective; all ranks of `network` call it, each with its own rows, of which it may have none.
/// Parts are as those of a `graph_partitioner`; the same rows on as many ranks give the same parts.
///
/// Complexity: that of a `graph_partitioner`, shared by the ranks or not.
///
/// Failure: throws `partition_error`, and `usage_error` for a network that it cannot speak over, on all ranks
/// alike. `any_distributed_partitioner` throws the first also for a result of another length, with parts out
/// of range or with an empty one.
///
/// Models: gathered, ptscotch, parmetis, any_distributed_partitioner.
template <class P>
concept distributed_graph_partitioner = std::copy_constructible<P> &&
    requires(const P& p, any_communicator& network, const distributed_csr_graph& g, int parts) {
  { p(network, g, parts) } -> std::same_as<std::vector<local_id>>;
  { p.depends_on_ranks() } -> std::convertible_to<bool>;
};

} // namespace dovetail
