/// @file
/// What `apportion.hpp` declares.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/partition/apportion.hpp"

#include <cstddef>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<int> apportion_parts(std::span<const double> component_weights,
                                                 std::span<const local_id> component_nodes, int parts) {
  std::vector<int> count(component_weights.size(), 1);
  std::priority_queue<std::pair<double, local_id>> heaviest; // by average weight, then the first component
  const auto offer = [&](std::size_t c) {
    if (count[c] < component_nodes[c])
      heaviest.emplace(component_weights[c] / count[c], -static_cast<local_id>(c));
  };
  for (std::size_t c = 0; c < count.size(); ++c)
    offer(c);
  for (int left = parts - static_cast<int>(count.size()); left > 0 && !heaviest.empty(); --left) {
    const auto c = static_cast<std::size_t>(-heaviest.top().second);
    heaviest.pop();
    ++count[c];
    offer(c);
  }
  return count;
}

} // namespace dovetail
