/// @file
/// What `refinement.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/refinement.hpp"

#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE bool partition_refiner::improve_cut() {
  std::vector<bool> locked(parts_.node_count(), false);
  move_queue queue;
  for (std::size_t v = 0; v < parts_.node_count(); ++v)
    offer(queue, static_cast<local_id>(v));
  std::vector<std::pair<local_id, local_id>> trail; // node, part it came from
  double gain = 0;
  double best_gain = 0;
  std::size_t best_length = 0;
  const std::size_t patience = 50 + parts_.node_count() / 100;
  while (!queue.empty() && trail.size() < best_length + patience) {
    const auto [promised, negated_node] = queue.top();
    const local_id v = -negated_node;
    queue.pop();
    if (locked[v])
      continue;
    const move best = best_move(v);
    if (best.to == no_id)
      continue;
    if (best.gain < promised) { // an older state of the node
      queue.emplace(best.gain, negated_node);
      continue;
    }
    trail.push_back({v, parts_.part_of(v)});
    locked[v] = true;
    parts_.move(v, best.to);
    gain += best.gain;
    if (gain > best_gain + tolerance()) {
      best_gain = gain;
      best_length = trail.size();
    }
    for (const local_id w : parts_.graph().row(v))
      if (!locked[w])
        offer(queue, w);
  }
  for (std::size_t k = trail.size(); k > best_length; --k)
    parts_.move(trail[k - 1].first, trail[k - 1].second);
  return best_length > 0;
}

DOVETAIL_INLINE partition_refiner::move partition_refiner::best_move(local_id v) {
  move best;
  if (parts_.nodes_in(parts_.part_of(v)) < 2)
    return best;
  parts_.gains().for_each_target(v, [&](local_id p, double gain) {
    if (parts_.weight(p) + parts_.weight_of_node(v) > parts_.limit(p))
      return;
    const auto key = [&](local_id q, double g) { return std::tuple(-g, parts_.weight(q), q); };
    if (best.to == no_id || key(p, gain) < key(best.to, best.gain))
      best = {p, gain};
  });
  return best;
}

} // namespace dovetail
