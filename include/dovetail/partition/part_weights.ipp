/// @file
/// What `part_weights.hpp` declares.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE void require_partitionable(local_id nodes, std::span<const double> weights, int parts,
                                           local_id first) {
  if (parts < 1)
    throw partition_error("cannot make " + std::to_string(parts) + " parts; ask for at least one");
  if (nodes < parts)
    throw partition_error("cannot make " + std::to_string(parts) + " parts of a graph with " +
                          std::to_string(nodes) + " nodes; ask for fewer parts or refine the coarse mesh");
  for (std::size_t v = 0; v < weights.size(); ++v)
    if (!(weights[v] >= 0) || weights[v] > 1e300)
      throw partition_error("node " + std::to_string(static_cast<std::size_t>(first) + v) + " has weight " +
                            number_text(weights[v]) + "; weights must be finite and not negative");
}

DOVETAIL_INLINE void fill_empty_parts(const csr_graph& graph, std::span<local_id> part, int parts) {
  const auto members = sorted_into_rows<local_id>(static_cast<std::size_t>(parts), [&](const auto& put) {
    for (std::size_t v = 0; v < part.size(); ++v)
      put(part[v], static_cast<local_id>(v));
  });
  std::vector<std::vector<local_id>> left(members.size()); // of donors: what they have, the lightest first
  std::set<std::pair<double, std::size_t>> donors;         // negated weight, part
  const auto weights = part_weights(graph, part, parts);
  for (std::size_t p = 0; p < members.size(); ++p)
    if (members[p].size() > 1)
      donors.insert({-weights[p], p});
  for (std::size_t empty = 0; empty < members.size(); ++empty) {
    if (!members[empty].empty())
      continue;
    const auto [negated_weight, donor] = *donors.begin();
    donors.erase(donors.begin());
    if (left[donor].empty()) {
      append(left[donor], members[donor]);
      sort_all(left[donor], [&](local_id a, local_id b) {
        const auto key = [&](local_id v) { return std::pair(graph.node_weights[v], -v); };
        return key(a) < key(b);
      });
    }
    const auto given = static_cast<std::size_t>(left[donor].back());
    left[donor].pop_back();
    part[given] = static_cast<local_id>(empty);
    if (left[donor].size() > 1)
      donors.insert({negated_weight + graph.node_weights[given], donor});
  }
}

} // namespace dovetail::detail
