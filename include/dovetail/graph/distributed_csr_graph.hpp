/// @file
/// A graph whose rows are spread over the ranks of a run.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/graph/csr_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dovetail {

/// What one rank has of it: the rows of its nodes, which are [first(), end()) of the whole graph.
struct distributed_csr_graph {
  std::vector<local_id> first_of_rank{0}; ///< size ranks + 1; the last is the number of all nodes
  int rank = 0;                           ///< of the rank whose rows these are
  csr_graph rows; ///< of this rank's nodes; neighbours by their numbers in the whole graph

  using fields = field_list<&distributed_csr_graph::first_of_rank, &distributed_csr_graph::rank,
                            &distributed_csr_graph::rows>;

  /// The first node of this rank; those of it end before `end()`.
  local_id first() const { return first_of_rank[rank]; }
  local_id end() const { return first_of_rank[static_cast<std::size_t>(rank) + 1]; }
  local_id node_count() const { return first_of_rank.back(); } ///< of the whole graph
};

/// A rank's share of a graph that all ranks have: blocks of about as many nodes. Linear in the share.
distributed_csr_graph rows_of_rank(const csr_graph& whole, int rank, int ranks);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/graph/distributed_csr_graph.ipp"
#endif
