/// @file
/// What `distributed_csr_graph.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/graph/distributed_csr_graph.hpp"

#include <cstddef>
#include <cstdint>

namespace dovetail {

DOVETAIL_INLINE distributed_csr_graph rows_of_rank(const csr_graph& whole, int rank, int ranks) {
  distributed_csr_graph share;
  share.rank = rank;
  share.first_of_rank.clear();
  for (std::int64_t r = 0; r <= ranks; ++r)
    share.first_of_rank.push_back(static_cast<local_id>(r * whole.node_count() / ranks));
  const auto copy = [](const auto& from, std::int64_t begin, std::int64_t end, auto& to) {
    to.assign(from.begin() + begin, from.begin() + end);
  };
  const local_id first = share.first(), end = share.end();
  const std::int64_t first_edge = whole.offsets[first];
  const std::int64_t end_edge = whole.offsets[end];
  csr_graph& rows = share.rows;
  copy(whole.offsets, first, end + 1, rows.offsets);
  for (std::int64_t& offset : rows.offsets)
    offset -= first_edge;
  copy(whole.neighbours, first_edge, end_edge, rows.neighbours);
  copy(whole.edge_weights, first_edge, end_edge, rows.edge_weights);
  copy(whole.node_weights, first, end, rows.node_weights);
  if (!whole.positions.empty())
    copy(whole.positions, first, end, rows.positions);
  return share;
}

} // namespace dovetail
