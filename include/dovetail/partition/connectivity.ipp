/// @file
/// What `connectivity.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/connectivity.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::size_t join_stray_components(const csr_graph& graph, std::span<local_id> part,
                                                  int parts) {
  const labelled_components found = components_within(graph, part);
  const auto count = static_cast<std::size_t>(found.count);
  std::vector<double> weight(count, 0.0);
  std::vector<local_id> part_of(count, no_id);
  for (std::size_t v = 0; v < part.size(); ++v) {
    weight[found.of_node[v]] += graph.node_weights[v];
    part_of[found.of_node[v]] = part[v];
  }
  std::vector<std::size_t> main(static_cast<std::size_t>(parts), count);
  for (std::size_t c = 0; c < count; ++c) {
    std::size_t& best = main[part_of[c]];
    if (best == count || weight[c] > weight[best])
      best = c;
  }
  if (std::count(main.begin(), main.end(), count) + found.count == parts)
    return 0; // each part that has nodes is one component
  std::vector<std::size_t> strays;
  for (std::size_t c = 0; c < count; ++c)
    if (main[part_of[c]] != c)
      strays.push_back(c);
  stable_sort_all(strays, [&](std::size_t a, std::size_t b) { return weight[a] < weight[b]; });

  csr_graph components = contract(graph, found.of_node, found.count);
  // Components that were joined, as a chain to where they went.
  std::vector<std::size_t> into(count);
  std::iota(into.begin(), into.end(), std::size_t{0});
  const auto resolve = [&](std::size_t c) {
    while (into[c] != c)
      c = into[c] = into[into[c]];
    return c;
  };
  std::vector<std::vector<std::size_t>> members(count);
  for (std::size_t c = 0; c < count; ++c)
    members[c] = {c};
  std::size_t joined = 0;
  std::vector<double> shared(count, 0.0); // weight shared with each component
  std::vector<std::size_t> neighbours;
  for (const std::size_t stray : strays) {
    if (resolve(stray) != stray)
      continue;
    neighbours.clear();
    for (const std::size_t member : members[stray]) {
      const auto row = components.row(static_cast<local_id>(member));
      const auto begin = static_cast<std::size_t>(components.offsets[member]);
      for (std::size_t k = 0; k < row.size(); ++k)
        if (const std::size_t other = resolve(static_cast<std::size_t>(row[k])); other != stray) {
          shared[other] += components.edge_weights[begin + k];
          neighbours.push_back(other);
        }
    }
    if (neighbours.empty())
      continue;
    sort_unique(neighbours); // so that ties go to the first
    std::size_t best = neighbours.front();
    for (const std::size_t other : neighbours)
      if (shared[other] > shared[best])
        best = other;
    for (const std::size_t other : neighbours)
      shared[other] = 0;
    into[stray] = best;
    auto& target = members[best];
    append(target, members[stray]);
    ++joined;
  }
  for (std::size_t v = 0; v < part.size(); ++v)
    part[v] = part_of[resolve(static_cast<std::size_t>(found.of_node[v]))];
  return joined;
}

} // namespace dovetail
