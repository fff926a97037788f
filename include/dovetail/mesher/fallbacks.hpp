/// @file
/// The ladder a failed piece climbs: the same mesher with other parameters, in a fixed order.
#pragma once

#include <concepts>
#include <vector>

namespace dovetail {

/// A mesher, or another policy, that knows what to try next: `m.fallbacks()` -> std::vector<M>.
template <class M>
concept has_fallbacks = requires(const M& m) {
  { m.fallbacks() } -> std::same_as<std::vector<M>>;
};

/// The mesher itself and then its fallbacks; never empty.
template <class M>
std::vector<M> ladder_of(const M& mesher) {
  std::vector<M> ladder{mesher};
  if constexpr (has_fallbacks<M>)
    for (const M& next : mesher.fallbacks())
      ladder.push_back(next);
  return ladder;
}

} // namespace dovetail
